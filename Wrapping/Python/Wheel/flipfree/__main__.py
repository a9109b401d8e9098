"""`python -m flipfree` is the command `flipfree`."""

import sys

from ._command import main

if __name__ == "__main__":
    sys.exit(main())
