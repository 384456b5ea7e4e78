/** The token that `urdd view` requires. All tabs of this browser share it. Storage is separate for each address and port,
 * so no other page or server of this machine can read it. */

const KEY = "urdd-token";

export function keptToken(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    // A sandboxed frame, as in a notebook, has no storage.
    return null;
  }
}

export function keepToken(token: string | null): void {
  try {
    if (token !== null) localStorage.setItem(KEY, token);
  } catch {
    // It lasts until the page is closed.
  }
}
