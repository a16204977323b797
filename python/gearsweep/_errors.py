"""The two ways in which a call fails, by who can mend it."""

from gearsweep._core import InputError, RunError

# Where users, tracebacks and pickles look for them.
for _error in (InputError, RunError):
    _error.__module__ = "gearsweep"
InputError.__doc__ = "The input was wrong; the message says what would be right."
RunError.__doc__ = "Something failed while running; the message says what and why."

__all__ = ["InputError", "RunError"]
