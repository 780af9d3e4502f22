"""Entry: `python3 -m fsi_launch VERB ...`."""

import sys

from fsi_launch.cli import main

sys.exit(main(sys.argv[1:]))
