"""Entry: `python3 -m fsi_launch VERB ...`. `launch/fsi` blocks SIGINT and SIGTERM until `main` is ready for them."""

import sys

from fsi_launch.living import interrupts
from fsi_launch.command.cli import main
from fsi_launch.failure import INTERRUPTED, TERMINATED

try:
    with interrupts.unwrapped():
        code = main(sys.argv[1:])
except KeyboardInterrupt:  # behind all handlers
    code = INTERRUPTED
except interrupts.Terminated:
    code = TERMINATED
interrupts.ignore_terminal()
sys.exit(code)
