#!/usr/bin/env python3
"""Regenerates the tables that the READMEs under configs/ quote, from records of the program as it is built.

    experiments/regenerate_tables.py [--data DIR] [--only NAME ...]

Runs the experiments behind the tables, checks the meshes of configs/bench/seven_volumes.json with `deliso verify`, and
replaces what stands between `<!-- generated: NAME -->` and `<!-- end of NAME -->`. Each section names the commit, the
machine and the runs that it comes from. The program must be built from a clean checkout, or else its commit means
nothing. Records go to out/tables/COMMIT; a second call goes on where the first was interrupted. Needs Python 3 alone.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BENCH_PAGE = "configs/bench/README.md"
ABLATIONS_PAGE = "configs/ablation/README.md"
COMPARE_PAGE = "configs/compare/README.md"
ANSWERS = "configs/ablation/answers.txt"

# Sections that show the table of one experiment as it is: name, page, experiment.
PLAIN = [
    ("table1", "configs/paper/README.md", "configs/paper/table1.json"),
    ("table2", "configs/paper/README.md", "configs/paper/table2.json"),
    ("table3", "configs/paper/README.md", "configs/paper/table3.json"),
    ("table4", "configs/paper/README.md", "configs/paper/table4.json"),
    ("error_against_size", "configs/paper/README.md", "configs/paper/error_against_size.json"),
    ("time_by_stage", "configs/paper/README.md", "configs/paper/time_by_stage.json"),
    ("seven_volumes", BENCH_PAGE, "configs/bench/seven_volumes.json"),
    ("noisy_isovalues", BENCH_PAGE, "configs/bench/noisy_isovalues.json"),
]

# Sections that put other meshers beside ours: name and experiment.
COMPARED = [("compare_" + name, f"configs/compare/{name}.json")
            for name in ("fields_vertices", "fields_error", "volumes_vertices", "volumes_error")]
OURS = "DelIso"


class Failure(Exception):
    """Ends the program with one sentence."""


def read_json(path):
    return json.loads(Path(path).read_text(encoding="utf-8"))


# ---- runs -----------------------------------------------------------------------------------------------------------


class Program:
    """The program `deliso` and where its volumes and results lie."""

    def __init__(self, path, data, out, allow_dirty):
        self.path, self.data = path, data
        version = self.call(["--version"])
        self.commit = re.search(r"^commit\s+(\S+)", version, re.M).group(1)
        if ("dirty" in self.commit or self.commit == "unknown") and not allow_dirty:
            raise Failure(f"{path} was built from commit {self.commit}: build it from a clean checkout")
        self.out = Path(out) / self.commit

    def call(self, arguments, accepted=(0,)):
        done = subprocess.run([self.path, *map(str, arguments)], stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode not in accepted:
            raise Failure(f"deliso {' '.join(map(str, arguments))} ended with {done.returncode}")
        return done.stdout

    def run(self, experiment, threads=1, accepted=(0,)):
        """The folder with the table of an experiment, run as far as it has not been."""
        folder = self.out / f"{threads}_threads" / Path(experiment).with_suffix("").relative_to("configs")
        print(f"== {experiment}, threads {threads}", flush=True)
        self.call(["run", ROOT / experiment, "--data", self.data, "--out", folder, "--threads", threads, "--resume",
                   "--progress"], accepted)
        return folder


class Results:
    """What an experiment found: its table, as text and as figures."""

    def __init__(self, folder, allow_absent, allow_failed=False):
        self.text = (folder / "table.md").read_text(encoding="utf-8")
        self.table = read_json(folder / "table.json")
        self.rows = [row for row in self.table["rows"] if row["state"] != "absent"]
        unfinished = [row for row in self.rows if row["state"] != "done"]
        if not self.rows:
            raise Failure(f"{folder.name}: all its data sets are absent")
        if unfinished and not allow_failed:
            raise Failure(f"{folder}: {unfinished[0]['dataset']} is {unfinished[0]['state']}")
        absent = {row["dataset"] for row in self.table["rows"] if row["state"] == "absent"}
        manifest = read_json(ROOT / "configs/reference/datasets.json")["datasets"]
        missing = sorted(absent & {dataset["name"] for dataset in manifest if "sha256" in dataset})
        if missing and not allow_absent:
            raise Failure(f"{folder}: {', '.join(missing)} is absent; see configs/reference/datasets.json")
        if len(self.table["programs"]) != 1:
            raise Failure(f"{folder}: the records come from {len(self.table['programs'])} programs, expected one")

    def cells(self, dataset, variant=""):
        for row in self.rows:
            if row["dataset"] == dataset and row.get("variant", "") == variant:
                return {cell["metric"]: cell for cell in row["cells"]}
        raise Failure(f"{self.table['experiment']}: no row for data set '{dataset}', variant '{variant}'")

    def datasets(self):
        return list(dict.fromkeys(row["dataset"] for row in self.rows))

    def variants(self):
        return list(dict.fromkeys(row.get("variant", "") for row in self.rows))

    def provenance(self):
        """Commit, compiler, machine and number of runs, in one sentence."""
        program = self.table["programs"][0]
        commit = re.search(r"commit (\S+),", program).group(1)
        compiler = re.search(r"commit \S+, ([^(]*[^( ])", program).group(1)
        return f"Commit {commit}, {compiler}; {machine()}."

    def runs(self, with_spread=True):
        """The number of runs behind each figure, in one sentence."""
        sentence = re.search(r"^(One run each.*|Median .* runs, seeds .*)$", self.text, re.M).group(1)
        return sentence if with_spread else re.sub(r"^Median \(\S+\)", "Medians", sentence)


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as stream:
        model = re.search(r"^model name\s*: (.*)$", stream.read(), re.M)
    cores = os.cpu_count()
    return f"{cores} cores, shared ({model.group(1).strip() if model else 'unknown'})"


# ---- figures --------------------------------------------------------------------------------------------------------


def figure_text(value, digits=3):
    if isinstance(value, str):
        return value
    if float(value).is_integer() and abs(value) < 1e15:
        return str(int(value))
    if abs(value) >= 10 ** digits:
        return f"{value:.0f}"
    return f"{value:.{digits}g}" if abs(value) >= 1e-3 else f"{value:.{digits - 1}e}".replace("e-0", "e-")


def percent_text(value):
    return f"{value:+d} %".replace("-", "−") if value else "0 %"


def spread(values, text):
    shown = list(dict.fromkeys(text(value) for value in sorted(values)))
    return shown[0] if len(shown) == 1 else f"{shown[0]} to {shown[-1]}"


def quoted(results, expression):
    """The figure that {DATASETS|VARIANTS|METRIC} or {DATASETS|VARIANTS|METRIC|%} in an answer stands for.

    DATASETS: one, several with commas, or * for all. VARIANTS: one, for its median; or two ("off over on") for the
    ratio of their medians, with % for the difference in percent. Of several data sets the smallest and the largest.
    """
    parts = expression.split("|")
    if len(parts) not in (3, 4):
        raise Failure(f"{ANSWERS}: '{{{expression}}}' has {len(parts)} parts, expected DATASETS|VARIANTS|METRIC[|%]")
    datasets = results.datasets() if parts[0] == "*" else parts[0].split(",")
    variants = parts[1].split(" over ")
    values = []
    for dataset in datasets:
        medians = []
        for variant in variants:
            cell = results.cells(dataset, variant).get(parts[2])
            if cell is None:
                raise Failure(f"{results.table['experiment']}: there is no metric '{parts[2]}'")
            medians.append(cell.get("median", cell.get("text")))
        values.append(medians[0] if len(medians) == 1 else medians[0] / medians[1])
    if len(parts) == 4:
        return spread([round(100 * (value - 1)) for value in values], percent_text)
    return spread(values, (lambda value: f"{value:.2g}") if len(variants) == 2 else figure_text)


# ---- sections -------------------------------------------------------------------------------------------------------


def markdown_table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|---|" + "---:|" * (len(header) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def plain_section(results):
    """The table as `deliso table` prints it, without the rows of absent data sets."""
    absent = {row["dataset"] for row in results.table["rows"] if row["state"] == "absent"}
    lines = [line for line in results.text.splitlines() if line.startswith("|")]
    kept = [line for line in lines if line.split("|")[1].strip() not in absent]
    text = "\n".join(kept) + f"\n\n{results.provenance()} {results.runs()}"
    return text + (f" Absent: {', '.join(sorted(absent))}." if absent else "")


def vertices_at(distance, curve):
    """How many vertices a mesh of a curve of (vertices, distance) would have at a distance: linear in the logarithms."""
    curve = sorted(curve)
    for (few, far), (many, near) in zip(curve, curve[1:]):
        if near <= distance <= far:
            share = math.log(far / distance) / math.log(far / near)
            return few * (many / few) ** share
    return None


def equal_distance_text(results):
    """How many vertices DelIso needs for the distance of marching cubes: by its meshes with a bound on h alone."""
    metric = "surface samples to mesh, mean (voxels)"
    found = []
    for dataset in results.datasets():
        curve = []
        for variant in results.variants():
            cells = results.cells(dataset, variant)
            if variant.startswith("h "):
                curve.append((cells["vertices"]["median"], cells[metric]["median"]))
        cells = results.cells(dataset, "marching cubes")
        vertices = vertices_at(cells[metric]["median"], curve)
        if vertices is not None:
            found.append(f"{dataset} about {float(f'{vertices:.2g}'):.0f} against {cells['vertices']['median']:.0f} at "
                         f"{cells[metric]['median']:.3f} voxel")
    return ("For the mean distance from the surface samples that marching cubes has, DelIso with a bound on h needs so "
            "many vertices (between two of the meshes above): " + "; ".join(found) + ".")


def fidelity_section(results):
    """Ours over the paper's, n_RC and n_RF: a row for each reading, a column for each data set."""
    rows = []
    for variant in results.variants():
        row = [variant]
        for dataset in results.datasets():
            cells = results.cells(dataset, variant)
            row.append(", ".join(f"{cells[name]['ratio']:.2f}" for name in ("n_RC", "n_RF")))
        rows.append(row)
    text = markdown_table(["reading"] + results.datasets(), rows)
    return text + f"\n\n{results.provenance()} {results.runs(with_spread=False)}"


def two_threads_section(one, two):
    """Whole runs with one thread and with two, beside each other."""
    rows = []
    for dataset in one.datasets():
        alone, together = one.cells(dataset), two.cells(dataset)
        if alone["vertices"]["median"] != together["vertices"]["median"]:
            raise Failure(f"{dataset}: another mesh with two threads")
        seconds = [cells["seconds"]["median"] for cells in (alone, together)]
        peaks = [cells["peak memory (bytes)"]["median"] / 2 ** 20 for cells in (alone, together)]
        per_vertex = [1e6 * value / alone["vertices"]["median"] for value in seconds]
        rows.append([dataset, *map(figure_text, seconds), f"{seconds[0] / seconds[1]:.2f}",
                     *(f"{value:.1f}" for value in per_vertex), *(f"{value:.0f}" for value in peaks)])
    header = ["data set", "one thread (s)", "two threads (s)", "times faster", "µs per vertex, one thread",
              "µs per vertex, two threads", "peak MiB, one thread", "peak MiB, two threads"]
    return markdown_table(header, rows) + f"\n\n{one.provenance()} {one.runs(with_spread=False)}"


# ---- other meshers --------------------------------------------------------------------------------------------------


def value(cells, metric):
    """The median of a figure, or its text; None where there is none."""
    cell = cells.get(metric, {})
    return cell.get("median", cell.get("text"))


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values)) if values else None


class Compared:
    """The meshers of an experiment beside each other, over the data sets that each has done."""

    def __init__(self, results):
        self.results = results
        self.meshers = results.variants()
        self.done = {(row["dataset"], row["variant"]): {cell["metric"]: cell for cell in row["cells"]}
                     for row in results.rows if row["state"] == "done"}

    def cells(self, mesher):
        return [self.done[dataset, mesher] for dataset in self.results.datasets() if (dataset, mesher) in self.done]

    def over_ours(self, mesher, metric):
        """The geometric mean of the quotients of a mesher's figures and ours; and on how many data sets ours is larger."""
        pairs = []
        for dataset in self.results.datasets():
            if (dataset, mesher) in self.done and (dataset, OURS) in self.done:
                theirs, ours = value(self.done[dataset, mesher], metric), value(self.done[dataset, OURS], metric)
                if theirs and ours:
                    pairs.append((theirs, ours))
        return geometric_mean([a / b for a, b in pairs]), sum(b > a for a, b in pairs), len(pairs)


def ratio_text(ratio):
    if ratio is None:
        return "–"
    return f"{ratio:.2g}" if ratio < 10 else f"{ratio:.0f}"


def compared_summary(compared):
    """A row for each mesher, over all data sets."""
    rows = []
    for mesher in compared.meshers:
        cells = compared.cells(mesher)

        def total(metric):
            return sum(value(one, metric) or 0 for one in cells)

        right = sum(value(one, "topology is right") == "true" for one in cells)
        proven = sum(value(one, "proven") == "true" for one in cells)
        rows.append([
            mesher, f"{right} of {len(cells)}", f"{total('components missed'):.0f} of {total('components'):.0f}",
            f"{total('pairs of triangles that cross'):.0f}", f"{proven} of {len(cells)}",
            *(ratio_text(compared.over_ours(mesher, metric)[0]) for metric in
              ("vertices", "surface to mesh, mean (voxels)", "surface to mesh, max (voxels)")),
            f"{min(value(one, 'smallest angle (degrees)') for one in cells):.2g}",
            *(ratio_text(compared.over_ours(mesher, metric)[0]) for metric in
              ("cold (s)", "whole program (s)", "peak memory (bytes)"))])
    header = ["mesher", "topology is right", "components missed", "pairs that cross", "proven", "vertices, over ours",
              "mean distance, over ours", "largest distance, over ours", "smallest angle (°)", "seconds, over ours",
              "whole program, over ours", "memory, over ours"]
    return markdown_table(header, rows)


def compared_datasets(compared):
    """A row for each data set, a column for each mesher: what it misses, its mean distance, smallest angle and time."""
    rows = []
    for dataset in compared.results.datasets():
        row = [dataset]
        for mesher in compared.meshers:
            cells = compared.done.get((dataset, mesher))
            if cells is None:
                row.append(next((one["state"] for one in compared.results.rows
                                 if (one["dataset"], one["variant"]) == (dataset, mesher)), "–"))
                continue
            missed = value(cells, "components missed")
            wrong = "" if value(cells, "topology is right") == "true" else "**wrong**, "
            if missed:
                wrong += f"misses {missed:.0f}, "
            seconds = value(cells, "cold (s)") or value(cells, "whole program (s)")
            row.append(f"{wrong}{figure_text(value(cells, 'vertices'))} v, "
                       f"{figure_text(value(cells, 'surface to mesh, mean (voxels)'), 2)}, "
                       f"{value(cells, 'smallest angle (degrees)'):.2g}°, {figure_text(seconds, 2)} s")
        rows.append(row)
    return markdown_table(["data set"] + compared.meshers, rows)


def compared_losses(compared):
    """Where another mesher is better than ours, in sentences."""
    sentences = []
    for metric, words in (("cold (s)", "faster"), ("peak memory (bytes)", "smaller in memory"),
                          ("vertices", "smaller in vertices"), ("surface to mesh, mean (voxels)", "nearer on the mean"),
                          ("surface to mesh, max (voxels)", "nearer at the worst point")):
        if metric == "vertices" and compared.results.table["experiment"].endswith("_vertices"):
            continue  # they were asked for
        better = []
        for mesher in compared.meshers:
            ratio, losses, count = compared.over_ours(mesher, metric)
            if mesher != OURS and losses and metric != "vertices" or (metric == "vertices" and ratio and ratio < 0.97):
                better.append(f"{mesher} on {losses} of {count} ({ratio_text(ratio)} times ours over all)")
        if better:
            sentences.append(f"{words}: " + "; ".join(better))
    shape = []
    ours = {dataset: compared.done[dataset, OURS] for dataset in compared.results.datasets()
            if (dataset, OURS) in compared.done}
    for mesher in compared.meshers:
        count = sum((dataset, mesher) in compared.done and
                    value(compared.done[dataset, mesher], "smallest angle (degrees)") >
                    value(cells, "smallest angle (degrees)") for dataset, cells in ours.items())
        if count and mesher != OURS:
            shape.append(f"{mesher} on {count} of {len(ours)}")
    if shape:
        sentences.append("better in the smallest angle: " + "; ".join(shape))
    wrong = [dataset for dataset, cells in ours.items() if value(cells, "proven") != "true"]
    if wrong:
        sentences.append(f"not proven, ours: {', '.join(wrong)}")
    if not sentences:
        rivals = {mesher for dataset, mesher in compared.done if mesher != OURS and dataset in ours}
        if not rivals:
            raise Failure(f"{compared.results.table['experiment']}: no other mesher has done a data set that ours has")
        return "Ours loses nowhere."
    return "Where ours loses, on how many data sets:\n\n" + "\n".join(f"- {sentence}." for sentence in sentences)


def compared_section(results):
    compared = Compared(results)
    for mesher in compared.meshers:
        if not compared.cells(mesher):
            raise Failure(f"{results.table['experiment']}: no run of {mesher} ended well, so there is nothing to "
                          "compare; tests/bench/peers/README.md says how the other meshers are made")
    text = compared_summary(compared)
    text += ("\n\nEach cell: vertices, mean distance from the surface to the mesh in voxels, smallest angle, seconds.\n\n" +
             compared_datasets(compared))
    failed = [f"{row['dataset']} with {row['variant']}" for row in results.rows if row["state"] != "done"]
    text += "\n\n" + compared_losses(compared)
    absent = {row["dataset"] for row in results.table["rows"] if row["state"] == "absent"}
    if absent:
        text += f"\n\nAbsent: {', '.join(sorted(absent))}."
    if failed:
        text += f"\n\nFailed or not run: {', '.join(failed)}."
    return text + f"\n\n{results.provenance()} {results.runs(with_spread=False)}"


# ---- more sections --------------------------------------------------------------------------------------------------


def read_answers():
    """name -> sentence, from lines `name: sentence`; an indented line goes on with the one before."""
    answers = {}
    name = None
    for line in (ROOT / ANSWERS).read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        if line[0].isspace():
            answers[name] += " " + line.strip()
        else:
            name, sentence = line.split(":", 1)
            answers[name] = sentence.strip()
    return answers


def answers_section(all_results):
    rows = []
    for name, sentence in read_answers().items():
        results = all_results[name]
        answer = re.sub(r"\{([^{}]*)\}", lambda match: quoted(results, match.group(1)), sentence)
        rows.append([f"`{name}`", results.table["question"], answer])
    header = "| config | question | answer |\n|---|---|---|\n"
    sources = {results.provenance() for results in all_results.values()}
    if len(sources) != 1:
        raise Failure(f"the ablations come from {len(sources)} programs, expected one")
    body = "\n".join("| " + " | ".join(row) + " |" for row in rows)
    return header + body + f"\n\n{sources.pop()} Medians of the runs that each config asks for."


def verification_section(program, allow_absent):
    """What `deliso verify` says of the mesh of each volume."""
    rows = []
    names = read_json(ROOT / "configs/bench/seven_volumes.json")["datasets"]
    manifest = {item["name"]: item for item in read_json(ROOT / "configs/reference/datasets.json")["datasets"]}
    folder = program.out / "verification"
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        item = manifest[name]
        volume = next((program.data / file for file in (item["file"], item.get("also", ""))
                       if file and (program.data / file).exists()), None)
        if volume is None:
            if allow_absent:
                continue
            raise Failure(f"{name} is absent; see configs/reference/datasets.json")
        print(f"== deliso verify, {name}", flush=True)
        mesh, report = folder / f"{name}.ply", folder / f"{name}.json"
        program.call(["mesh", volume, "--isovalue", item["isovalue"], "-o", mesh, "--quiet"], accepted=(0, 1))
        program.call(["verify", mesh, volume, "--isovalue", item["isovalue"], "--report", report], accepted=(0, 1))
        found = read_json(report)
        checks = found["checks"]
        rows.append([
            name,
            "yes" if found["proven"] else "no",
            figure_text(checks["self_intersection"]["crossing_pairs"] + checks["self_intersection"]["touching_pairs"]),
            figure_text(checks["residual"]["distance"]["max_voxels"], 2),
            figure_text(checks["distance"]["isosurface_to_mesh"]["max_voxels"], 2),
            figure_text(checks["distance"]["mesh_to_isosurface"]["max_voxels"], 2),
            figure_text(checks["normals"]["fraction_against"], 2),
            figure_text(checks["delaunay_balls"]["occupied"] / found["triangles"], 2),
        ])
    header = ["data set", "proven", "pairs of triangles that cross or touch", "vertices to surface, max (voxels)",
              "grid-edge crossings to mesh, max (voxels)", "triangles to surface, max (voxels)",
              "share of triangles against the gradient", "share of occupied surface Delaunay balls"]
    return markdown_table(header, rows) + f"\n\nCommit {program.commit}, default parameters, seed 1."


def replace_section(page, name, text):
    """Puts a text between the markers of a section."""
    content = page.read_text(encoding="utf-8")
    begin, end = f"<!-- generated: {name} -->\n", f"<!-- end of {name} -->"
    first, last = content.find(begin), content.find(end)
    if first < 0 or last < first:
        raise Failure(f"{page}: has no section '{name}'")
    page.write_text(content[:first + len(begin)] + "\n" + text + "\n\n" + content[last:], encoding="utf-8")
    print(f"   {page}: {name}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default=os.environ.get("DELISO_DATA", ROOT / "data"), type=Path,
                        help="folder with the volumes (default: $DELISO_DATA, else data/)")
    parser.add_argument("--deliso", default=ROOT / "build/release/experiments/deliso", help="the program")
    parser.add_argument("--out", default=ROOT / "out/tables", help="folder for records (default: out/tables)")
    parser.add_argument("--pages", default=ROOT, type=Path, help="where the READMEs are (default: this checkout)")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these sections alone")
    parser.add_argument("--allow-absent", action="store_true", help="for trials: leave absent volumes out")
    parser.add_argument("--allow-dirty", action="store_true", help="for trials: any program will do")
    parser.add_argument("--list", action="store_true", help="name the sections and do nothing else")
    options = parser.parse_args()
    names = [name for name, _, _ in PLAIN] + ["two_threads", "verification", "fidelity", "ablations"]
    names += [name for name, _ in COMPARED]
    if options.list:
        print("\n".join(names))
        return
    unknown = [name for name in options.only or [] if name not in names]
    if unknown:
        raise Failure(f"there is no section '{unknown[0]}', but {', '.join(names)}")
    program = Program(options.deliso, options.data, options.out, options.allow_dirty)

    def is_wanted(name):
        return options.only is None or name in options.only

    def results_of(experiment, threads=1):
        return Results(program.run(experiment, threads), options.allow_absent)

    for name, page, experiment in PLAIN:
        if is_wanted(name):
            results = results_of(experiment)
            text = plain_section(results)
            if name == "error_against_size":
                text += "\n\n" + equal_distance_text(results)
            replace_section(options.pages / page, name, text)
    if is_wanted("two_threads"):
        both = [results_of("configs/bench/seven_volumes.json", threads) for threads in (1, 2)]
        replace_section(options.pages / BENCH_PAGE, "two_threads", two_threads_section(*both))
    if is_wanted("verification"):
        section = verification_section(program, options.allow_absent)
        replace_section(options.pages / BENCH_PAGE, "verification", section)
    if is_wanted("fidelity"):
        section = fidelity_section(results_of("configs/ablation/fidelity.json"))
        replace_section(options.pages / ABLATIONS_PAGE, "fidelity", section)
    for name, experiment in COMPARED:
        if is_wanted(name):
            results = Results(program.run(experiment, accepted=(0, 1)), options.allow_absent, allow_failed=True)
            replace_section(options.pages / COMPARE_PAGE, name, compared_section(results))
    if is_wanted("ablations"):
        all_results = {name: results_of(f"configs/ablation/{name}.json") for name in read_answers()}
        replace_section(options.pages / ABLATIONS_PAGE, "ablations", answers_section(all_results))


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        print(f"regenerate_tables.py: {failure}", file=sys.stderr)
        sys.exit(1)
