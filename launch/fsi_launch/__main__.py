"""Entry: `python3 -m fsi_launch VERB ...`."""

import signal
import sys

try:
    from fsi_launch.cli import main
    code = main(sys.argv[1:])
except KeyboardInterrupt:  # before or behind all handlers
    code = 130
signal.signal(signal.SIGINT, signal.SIG_IGN)  # nothing is left to interrupt
sys.exit(code)
