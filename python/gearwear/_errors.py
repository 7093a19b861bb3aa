"""What can go wrong."""


class GearwearError(Exception):
    """A command that came to no result; `code` is the program's exit code: 2 for unusable input, 3 for missing parts, else 1."""

    def __init__(self, message, code=1):
        super().__init__(message)
        self.code = code


class StudyError(GearwearError):
    """A study or measurement file that cannot be used: where (file, line and column from 1, key), what was found, what is allowed."""

    def __init__(self, message, file="", line=None, column=None, key="", found="", allowed=""):
        super().__init__(message, 2)
        self.file = file
        self.line = line
        self.column = column
        self.key = key
        self.found = found
        self.allowed = allowed
