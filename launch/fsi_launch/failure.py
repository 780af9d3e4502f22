"""How the command ends: the exit codes of common/core/failure.hpp and one line that explains."""

DONE = 0
EXPECTATION_MISSED = 1
INTERNAL_ERROR = 1
USER_MISTAKE = 2
NUMBERS_BROKE = 3
PEER_LOST = 4
OUTPUT_FAILED = 5
INTERRUPTED = 130
NOBODY_READS = 141   # as of tools that SIGPIPE ends
TERMINATED = 143


class Failure(Exception):
    """Ends the command with a code and a message of one line (or a few, one per offence)."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


class UserMistake(Failure):
    """What the user typed or wrote is wrong: exit 2."""

    def __init__(self, message):
        super().__init__(USER_MISTAKE, message)
