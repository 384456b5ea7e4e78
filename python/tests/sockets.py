"""The sockets on which this process listens."""

from __future__ import annotations

import ipaddress
from pathlib import Path


def listening() -> set[tuple[str, int]]:
    """The TCP addresses and ports, for both versions of IP."""
    own = {str(link.readlink()) for link in Path("/proc/self/fd").iterdir() if link.is_symlink()}
    found: set[tuple[str, int]] = set()
    for table in ("tcp", "tcp6"):
        for line in Path("/proc/self/net", table).read_text(encoding="ascii").splitlines()[1:]:
            words = line.split()
            address, port = words[1].split(":")
            if words[3] == "0A" and f"socket:[{words[9]}]" in own:
                # Words of 32 bits, each in the byte order of this machine.
                parts = [bytes.fromhex(address[k : k + 8])[::-1] for k in range(0, len(address), 8)]
                found.add((str(ipaddress.ip_address(b"".join(parts))), int(port, 16)))
    return found
