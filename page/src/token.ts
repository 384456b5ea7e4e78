/** The token by which `urdd view` knows its page. All tabs of this browser share it: storage is of this address and port
 * alone, so no other page and no other server of this machine has it. */

const KEY = "urdd-token";

export function keptToken(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    // A frame that may keep nothing, as in a notebook.
    return null;
  }
}

export function keepToken(token: string | null): void {
  try {
    if (token !== null) localStorage.setItem(KEY, token);
  } catch {
    // It holds until the page is left.
  }
}
