"""`python -m hypofab COMMAND`: the commands of the package (hypofab.cli.commands)."""

import sys

from hypofab.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
