"""The study of record_results.py about random outlines: does what `check` calls fine run?"""

import shlex
import subprocess

COMMAND = ["tests/regression/robustness/campaign.py"]


def campaign(root):
    """The campaign's table, and a line for each case that did not end well or was refused."""
    answer = subprocess.run(COMMAND, cwd=root, capture_output=True, text=True, check=False)
    lines = answer.stdout.splitlines()
    table = [line for line in lines if line.startswith("|")]
    wrong = [line for line in lines if any(word in line for word in (" FAILED ", " NO PLACE ", " NOT HIT ", " refused "))]
    if not table:
        return f"exit code {answer.returncode}: {answer.stderr.strip()[-300:]}\n"
    return (f"`{shlex.join(COMMAND)}`, exit code {answer.returncode}\n\n" + "\n".join(table) + "\n"
            + ("\nNot run to the end:\n\n```\n" + "\n".join(wrong) + "\n```\n" if wrong else ""))


def studies(tools):
    yield "Random outlines met by a shock", lambda: campaign(tools.ROOT)
