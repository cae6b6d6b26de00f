"""Help for the scripts in Python that have no parser of their own."""
import sys


def answer(text, *options):
    """Prints the script's docstring `text` and ends it: for --help or -h with status 0, for an option other than
    `options` with status 2."""
    for argument in sys.argv[1:]:
        asked = argument in ("--help", "-h")
        if asked or (argument.startswith("-") and argument not in options):
            print(text, file=sys.stdout if asked else sys.stderr)
            sys.exit(0 if asked else 2)
