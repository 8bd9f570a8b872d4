"""``python -m nag`` is the command ``nag``."""

import sys

from nag.cli import main

if __name__ == "__main__":
    sys.exit(main())
