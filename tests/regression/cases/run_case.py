#!/usr/bin/python3
"""run_case.py CASE [--set KEY=VALUE]..: runs a case of configs/ in a scratch folder; exit 0 if it ends well and meets its
`expect:`."""

import os
import subprocess
import sys
import tempfile

with tempfile.TemporaryDirectory(prefix="fsi-case-") as scratch:
    command = [os.path.join(os.environ["FSI_ROOT"], "launch", "fsi"), "run", *sys.argv[1:], "--out", f"{scratch}/run"]
    sys.exit(subprocess.run(command, stdin=subprocess.DEVNULL, check=False).returncode)
