"""Entry: `python3 -m fsi_launch VERB ...`. `launch/fsi` blocks SIGINT and SIGTERM until `main` is ready for them."""

import signal
import sys

from fsi_launch.cli import main
from fsi_launch.failure import Failure

try:
    code = main(sys.argv[1:])
except KeyboardInterrupt:  # behind all handlers
    code = 130
except Failure as failure:  # SIGTERM there
    code = failure.code
signal.signal(signal.SIGINT, signal.SIG_IGN)  # nothing is left to interrupt
sys.exit(code)
