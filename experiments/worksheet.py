#!/usr/bin/env python3
"""Runs the commands of a page and shows it with what they print: the solutions of the lab sheet, the outputs of the errata.

    experiments/worksheet.py [--deliso PATH] configs/teaching/lab.md              # prints the page with all outputs
    experiments/worksheet.py [--deliso PATH] --check configs/teaching/errata.md   # are the page's outputs true?
    experiments/worksheet.py [--deliso PATH] --write configs/teaching/errata.md   # puts them in

A line that begins with "$ " in a block marked as `console` is a command; what stands below it, up to the next command or
the end of the block, is its output. Commands run in bash, one after the other, in an empty folder in which `configs` and
`experiments` are those of the project and `deliso` is the program. A command that fails ends the script. Needs Python 3
alone.
"""
import argparse
import difflib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BEGIN, END, PROMPT = "```console", "```", "$ "


class Failure(Exception):
    """Ends the program with one sentence."""


class Shell:
    """Runs commands in a folder that has what the pages speak of."""

    def __init__(self, folder, program):
        self.folder = folder
        programs = Path(folder) / "programs"
        programs.mkdir()
        (programs / "deliso").symlink_to(program)
        for name in ("configs", "experiments"):
            (Path(folder) / name).symlink_to(ROOT / name)
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}

    def run(self, command):
        """The lines that a command prints, those on stderr after those on stdout."""
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, capture_output=True,
                              text=True, check=False)
        if done.returncode != 0:
            raise Failure(f"ended with {done.returncode}: {command}\n{done.stdout}{done.stderr}")
        return [line.rstrip() for line in (done.stdout + done.stderr).splitlines()]


def played(lines, run):
    """The lines of a page with new outputs."""
    result = []
    inside = False
    for line in lines:
        if not inside:
            result.append(line)
            inside = line == BEGIN
        elif line == END:
            result.append(line)
            inside = False
        elif line.startswith(PROMPT):
            result.append(line)
            result += run(line[len(PROMPT):])
    if inside:
        raise Failure(f"a block that begins with {BEGIN} has no end")
    return result


def squeezed(lines):
    """Lines without what blanks align: columns are as wide as the seconds of a run, which no page shows."""
    return [" ".join(line.split()) for line in lines]


def program_path(wanted):
    candidates = [Path(wanted)] if wanted else [ROOT / f"build/{preset}/experiments/deliso" for preset in ("release", "dev")]
    for path in candidates:
        if path.is_file():
            return path.resolve()
    raise Failure(f"no program: {' or '.join(map(str, candidates))}; build it, or name it with --deliso")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("page", type=Path, help="a page with console blocks")
    parser.add_argument("--deliso", help="the program; default: build/release/experiments/deliso, else that of build/dev")
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--check", action="store_true", help="print nothing but the lines that are not true")
    action.add_argument("--write", action="store_true", help="put the outputs into the page")
    arguments = parser.parse_args()

    program = program_path(arguments.deliso)
    old = arguments.page.read_text(encoding="utf-8").rstrip("\n").split("\n")
    with tempfile.TemporaryDirectory() as folder:
        new = played(old, Shell(folder, program).run)
    if squeezed(new) == squeezed(old):
        new = old
    if arguments.check:
        difference = list(difflib.unified_diff(old, new, str(arguments.page), "as it is now", lineterm=""))
        print("\n".join(difference), end="\n" if difference else "")
        return 1 if difference else 0
    text = "\n".join(new) + "\n"
    if arguments.write:
        arguments.page.write_text(text, encoding="utf-8")
    else:
        print(text, end="")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (Failure, OSError) as failure:
        print(f"worksheet.py: {failure}", file=sys.stderr)
        sys.exit(2)
