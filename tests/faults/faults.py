#!/usr/bin/env python3
"""Faults of the system while `deliso` runs: it is killed, disks are full, memory is short, files change, clocks jump.

    faults.py PROGRAM NAME [--long]

Whatever happens: an output is whole or absent, the exit code is one of the documented ones, and a refusal is one line.
Ends with 77 where a fault cannot be made here, after saying why.
"""

import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SKIPPED = 77
DONE, NOT_PROVEN, BAD_INPUT, STOPPED = 0, 1, 2, 3
SEED = 20070607
MOST_SECONDS = 40  # of trials in the short form, for slow machines and sanitizers


def skip(why):
    print("skipped:", why)
    sys.exit(SKIPPED)


def require(holds, *what):
    if not holds:
        print("does not hold:", *what)
        sys.exit(1)


class Place:
    """A folder with a volume, and the program."""

    def __init__(self, program, folder, is_long):
        self.program, self.folder, self.is_long = program, Path(folder), is_long
        self.random = random.Random(SEED)
        self.run("generate", "gyroid", "--size", "24", "-o", "v.nrrd", expect=[DONE])
        self.inputs = sorted(self.names())

    def names(self):
        return {p.name for p in self.folder.iterdir()}

    def start(self, *arguments, **options):
        return subprocess.Popen([self.program, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, **options)

    def end(self, process, expect=None, limit=120):
        try:
            out, err = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
        result = subprocess.CompletedProcess(process.args, process.returncode, out.decode(), err.decode())
        if expect is not None:
            require(result.returncode in expect, result.args, "ended with", result.returncode, result.stderr)
        return result

    def run(self, *arguments, expect=None, **options):
        return self.end(self.start(*arguments, **options), expect)

    def mesh(self, *more):
        return ("mesh", "v.nrrd", "--isovalue", "0.1", "-o", "m.ply", "--stage1-out", "s.ply", "--report", "r.json",
                "--quiet", *more)

    def clear(self):
        for name in self.names() - set(self.inputs):
            path = self.folder / name
            shutil.rmtree(path) if path.is_dir() else path.unlink()

    def trials(self, count, long_count):
        """Counts trials; in the short form no more than fit into a while, at least three."""
        begin = time.monotonic()
        for n in range(long_count if self.is_long else count):
            if not self.is_long and n >= 3 and time.monotonic() - begin > MOST_SECONDS:
                print(f"{n} of {count} trials took {MOST_SECONDS} s")
                return
            yield n

    def read(self, name):
        path = self.folder / name
        return path.read_bytes() if path.exists() else None


def require_refusal(result, place):
    """Exit code 2, one line that says why, and no output."""
    lines = result.stderr.splitlines()
    require(result.returncode == BAD_INPUT, result.args, "ended with", result.returncode, result.stderr)
    require(len(lines) == 1 and lines[0].startswith("deliso: ") and "bad_alloc" not in lines[0], "one line:", lines)
    require(not place.names() - set(place.inputs), "nothing is left of", result.args, place.names())


def killed(place):
    """kill -9 at random moments: every output is whole or absent, and what is left behind is in nobody's way."""
    begin = time.monotonic()
    place.run(*place.mesh(), expect=[DONE])
    seconds = time.monotonic() - begin
    whole = {name: place.read(name) for name in ("m.ply", "s.ply")}
    place.clear()
    ended = 0
    for _ in place.trials(100, 400):
        process = place.start(*place.mesh())
        time.sleep(place.random.uniform(0, 1.1 * seconds))
        process.kill()
        ended += place.end(process).returncode == DONE
        for name, bytes_ in whole.items():
            require(place.read(name) in (None, bytes_), name, "is whole or absent")
        report = place.read("r.json")
        require(report is None or "schema" in json.loads(report), "the report is whole or absent")
        for name in whole:
            (place.folder / name).unlink(missing_ok=True)
        (place.folder / "r.json").unlink(missing_ok=True)
    left = place.names() - set(place.inputs)
    require(all(".part-" in name for name in left), "what is left has a name of its own:", left)
    place.run(*place.mesh(), expect=[DONE])
    require(all(place.read(name) == bytes_ for name, bytes_ in whole.items()), "the next run is as any other")
    print(f"{ended} runs ended before they were killed, {len(left)} temporary files were left")


def killed_experiment(place):
    """kill -9 during an experiment: --resume goes on, and the table has every run."""
    experiment = {
        "title": "Killed", "question": "Is every run there?", "base": {"name": "default", "parameters": {}},
        "datasets": [{"name": "sphere", "field": "sphere", "size": 16},
                     {"name": "torus", "field": "torus", "size": 16}],
        "variants": [{"name": "two_stage", "extends": "default"},
                     {"name": "full3d", "extends": "default", "set": {"algorithm": "full3d"}}],
        "repeats": 3,
        "metrics": [{"name": "vertices", "value": "vertices"}, {"name": "verdict", "value": "certificate.verdict"}],
    }
    (place.folder / "e.json").write_text(json.dumps(experiment))
    command = ("run", "e.json", "--builtin", "--out", "out", "--resume", "--quiet")
    begin = time.monotonic()
    place.run(*command, expect=[DONE])
    seconds = time.monotonic() - begin
    table = place.read("out/table.md")
    require(table is not None, "there is a table")
    for _ in place.trials(4, 20):
        shutil.rmtree(place.folder / "out")
        for _ in range(3):
            process = place.start(*command)
            time.sleep(place.random.uniform(0, 0.6 * seconds))
            process.kill()
            place.end(process)
        place.run(*command, expect=[DONE])
        require(place.read("out/table.md") == table, "the table has every run")


def full_disk(place):
    """A file system without room: one line, exit code 2, and nothing half-written."""
    if os.getuid() != 0:
        skip("only root can mount a small file system")
    small = place.folder / "small"
    small.mkdir()
    for kilobytes in (16, 64, 256, 1024):
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "none", small],
                          capture_output=True).returncode != 0:
            skip("no file system can be mounted here")
        try:
            for command in (
                    ("mesh", "v.nrrd", "--isovalue", "0.1", "-o", "small/m.ply", "--report", "small/r.json", "--quiet"),
                    ("generate", "gyroid", "--size", "60", "--encoding", "raw", "-o", "small/g.nrrd"),
                    ("render", "v.nrrd", "--isovalue", "0.1", "-o", "small/p.png", "--size", "600x600", "--samples",
                     "1")):
                result = place.run(*command, expect=[DONE, BAD_INPUT])
                left = sorted(p.name for p in small.iterdir())
                print(kilobytes, command[0], result.returncode, left, result.stderr.strip())
                if result.returncode == BAD_INPUT:
                    require(len(result.stderr.splitlines()) == 1 and "small/" in result.stderr, result.stderr)
                    # The report comes last: where only its room is lacking, the mesh stands.
                    require(left in ([], ["m.ply"]) and (left == [] or "r.json" in result.stderr), left)
                for path in small.iterdir():
                    path.unlink()
        finally:
            subprocess.run(["umount", small], check=True)


def short_file(place):
    """The same by a limit on the size of files, which needs no root."""
    for kilobytes in (0, 1, 16, 64, 128):
        limit = (1024 * kilobytes, 1024 * kilobytes)
        for command in (place.mesh(), ("generate", "gyroid", "--size", "60", "-o", "g.nrrd")):
            result = place.run(*command, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, limit))
            require(result.returncode in (DONE, BAD_INPUT), result)
            left = place.names() - set(place.inputs)
            require(not any(".part-" in name for name in left), "no temporary file is left:", left)
            if result.returncode == BAD_INPUT:
                require(len(result.stderr.splitlines()) == 1, result.stderr)
            place.clear()


def read_only(place):
    """A folder that cannot be written to."""
    closed = place.folder / "closed"
    closed.mkdir(mode=0o555)
    nobody = 65534
    as_nobody = {"user": nobody, "group": nobody, "extra_groups": []} if os.getuid() == 0 else {}
    place.folder.chmod(0o755)
    place.inputs = sorted(place.names())
    try:
        place.run("--version", expect=[DONE], **as_nobody)
    except PermissionError:
        skip("no other user may run the program from here")
    for command in (("mesh", "v.nrrd", "--isovalue", "0.1", "-o", "closed/m.ply"),
                    ("mesh", "v.nrrd", "--isovalue", "0.1", "-o", "/dev/null/m.ply"),
                    ("generate", "sphere", "-o", "closed/v.nrrd"),
                    ("info", "v.nrrd", "--report", "closed/r.json"),
                    ("render", "v.nrrd", "--isovalue", "0.1", "-o", "closed/p.png")):
        require_refusal(place.run(*command, **as_nobody), place)
        require(not list(closed.iterdir()), "nothing is left")


def little_memory(place):
    """ulimit -v at many values: done, or one line and exit code 2; never a crash."""
    place.run("mesh", "v.nrrd", "--isovalue", "0.1", "-o", "i.ply", "--quiet", expect=[DONE])
    place.inputs = sorted(place.names())
    commands = [place.mesh("--threads", "4"), place.mesh(), ("verify", "i.ply", "v.nrrd", "--isovalue", "0.1"),
                ("topology", "v.nrrd", "--isovalue", "0.1"), ("info", "v.nrrd", "--report", "r.json"),
                ("render", "v.nrrd", "--isovalue", "0.1", "-o", "p.png", "--size", "60x60", "--threads", "3"),
                ("generate", "gyroid", "--size", "40", "-o", "g.nrrd"), ("schema",)]
    refused = 0
    for kilobytes in range(7000, 60000, 151 if place.is_long else 3023):
        limit = (1024 * kilobytes, 1024 * kilobytes)
        limited = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_AS, limit)}
        # Where not even the libraries find room, the system's loader says so, or crashes before the program begins.
        if place.run("--version", **limited).returncode != DONE:
            continue
        for command in commands:
            result = place.run(*command, **limited)
            if result.returncode != DONE:
                refused += 1
                print(kilobytes, command[0])
                require_refusal(result, place)
            place.clear()
    require(refused > 0, "some limit was too small")


def shrinking_input(place):
    """A volume that becomes shorter while it is read, or while it is mapped into memory: one line, exit code 2."""
    place.run("generate", "sphere", "--size", "262", "--encoding", "raw", "-o", "large.nrrd", expect=[DONE])
    size = (place.folder / "large.nrrd").stat().st_size
    require(size > 64 << 20, "the volume is large enough to be mapped")
    place.inputs = sorted(place.names())
    begin = time.monotonic()
    command = ("topology", "large.nrrd", "--isovalue", "0.3", "--report", "r.json")
    place.run(*command, expect=[DONE])
    seconds = time.monotonic() - begin
    place.clear()
    said = trials = 0
    for _ in place.trials(12, 60):
        trials += 1
        process = place.start(*command)
        time.sleep(place.random.uniform(0.1, 0.9) * seconds)
        os.truncate(place.folder / "large.nrrd", place.random.choice((0, 1, size // 3, size - 4096)))
        result = place.end(process)
        if result.returncode != DONE:
            require_refusal(result, place)
        said += "became shorter" in result.stderr
        place.clear()
        place.run("generate", "sphere", "--size", "262", "--encoding", "raw", "-o", "large.nrrd", expect=[DONE])
    print(f"{said} of {trials} runs saw the file become shorter")
    require(said > 0, "a mapped file became shorter")


def two_signals(place):
    """Two signals in a row, as `timeout` sends them, ask once: the partial mesh is written."""
    place.run("generate", "gyroid", "--size", "64", "-o", "large.nrrd", expect=[DONE])
    command = ("mesh", "large.nrrd", "--isovalue", "0.1", "-o", "m.ply", "--report", "r.json", "--quiet",
               "--set", "stage2.epsilon1=0.005", "--set", "stage2.epsilon2=0.01", "--set", "r_min_of=box")
    gaps = (0, 0, 0.001, 0.01, 0.1, 0.3, 0.8) if place.is_long else (0, 0.01, 0.3)
    for first, second in ((signal.SIGTERM, signal.SIGTERM), (signal.SIGINT, signal.SIGTERM)):
        for gap in gaps:
            process = place.start(*command)
            time.sleep(1)
            process.send_signal(first)
            time.sleep(gap)
            process.send_signal(second)
            place.end(process, expect=[STOPPED])
            report = json.loads(place.read("r.json"))
            require(report["stopped_early"] and report["certificate"]["manifold"], "a valid partial mesh")
            require(place.read("m.ply").startswith(b"ply"), "the mesh is there")
            for name in ("m.ply", "r.json"):
                (place.folder / name).unlink()
    if shutil.which("timeout"):
        result = subprocess.run(["timeout", "1", place.program, *command], cwd=place.folder, capture_output=True)
        require(result.returncode == 124 and place.read("m.ply") is not None, "timeout leaves the mesh", result)


def clock(place):
    """The wall clock jumps: times are measured on the steady clock, and a budget is kept."""
    if not shutil.which("faketime"):
        skip("there is no faketime (Debian package faketime)")
    expected = place.run(*place.mesh(), expect=[DONE]) and place.read("m.ply")
    for jump in ("-30y", "+10y x1000", "+1y x0.01"):
        place.clear()
        environment = dict(os.environ, DONT_FAKE_MONOTONIC="1", FAKETIME_DONT_FAKE_MONOTONIC="1")
        result = subprocess.run(["faketime", "-f", jump, place.program, *place.mesh("--set", "budget.seconds=100")],
                                cwd=place.folder, capture_output=True, env=environment)
        require(result.returncode == DONE, jump, result)
        require(place.read("m.ply") == expected, "the same mesh")
        seconds = json.loads(place.read("r.json"))["total_seconds"]
        require(0 <= seconds < 100, jump, seconds)


FAULTS = {f.__name__: f for f in (killed, killed_experiment, full_disk, short_file, read_only, little_memory,
                                  shrinking_input, two_signals, clock)}


def main():
    program, name = str(Path(sys.argv[1]).resolve()), sys.argv[2]
    with tempfile.TemporaryDirectory(prefix="deliso-faults-") as folder:
        FAULTS[name](Place(program, folder, "--long" in sys.argv))


if __name__ == "__main__":
    main()
