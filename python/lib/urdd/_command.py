"""The command line, in this process."""

from __future__ import annotations

import os
import signal
import sys

from . import _urdd


def main() -> None:
    """Runs the command line with the arguments of ``sys.argv``, and ends the process with its status."""
    closed = sys.stdout is None  # pyright: ignore[reportUnnecessaryComparison]
    if closed:
        # The next file that is opened would become standard output.
        nothing = os.open(os.devnull, os.O_WRONLY)
        if nothing != 1:
            os.dup2(nothing, 1)
    # Ctrl-C is for the program; Python would only record it.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    status = _urdd.main(["urdd", *sys.argv[1:]], closed)
    # Python has nothing left to do, and threads of the program may still run.
    os._exit(status)


if __name__ == "__main__":
    main()
