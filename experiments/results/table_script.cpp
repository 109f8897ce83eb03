#include "experiments/results/table_files.h"
#include "experiments/runs/plot_config.h"

namespace deliso {
namespace {

constexpr const char* kScript = R"py(import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent
TABLE = json.loads((HERE / "table.json").read_text(encoding="utf-8"))
ROWS = [row for row in TABLE["rows"] if row["state"] == "done"]
DATASETS = list(dict.fromkeys(row["dataset"] for row in ROWS))
VARIANTS = list(dict.fromkeys(row.get("variant", "") for row in ROWS))


def cell(dataset, variant, metric):
    """median, smallest and largest of a figure; None where there is none."""
    for row in ROWS:
        if row["dataset"] == dataset and row.get("variant", "") == variant:
            for one in row["cells"]:
                if one["metric"] == metric and "median" in one:
                    return one["median"], one["min"], one["max"]
    return None


def curve(plot):
    across = plot.get("across") == "datasets"
    panels = VARIANTS if across else DATASETS
    figure, axes = plt.subplots(len(plot["y"]), len(panels), squeeze=False,
                                figsize=(4 * len(panels), 3 * len(plot["y"])))
    for column, panel in enumerate(panels):
        for line, y in enumerate(plot["y"]):
            axis = axes[line][column]
            for series in plot["series"]:
                at = [(m, panel) if across else (panel, m) for m in series["members"]]
                points = [(cell(*key, plot["x"]), cell(*key, y)) for key in at]
                points = [(a, b) for a, b in points if a and b]
                if not points:
                    continue
                axis.errorbar([a[0] for a, _ in points], [b[0] for _, b in points],
                              yerr=[[b[0] - b[1] for _, b in points], [b[2] - b[0] for _, b in points]],
                              marker="o", label=series["name"])
            axis.set(title=panel, xlabel=plot["x"], ylabel=y)
            axis.set_xscale("log" if "x" in plot.get("log", []) else "linear")
            axis.set_yscale("log" if "y" in plot.get("log", []) else "linear")
    axes[0][0].legend()
    return figure


def bars(plot):
    keys = [(row["dataset"], row.get("variant", "")) for row in ROWS]
    figure, axis = plt.subplots(figsize=(8, 1 + 0.4 * len(keys)))
    left = [0.0] * len(keys)
    wholes = [sum((cell(*key, y) or (0,))[0] for y in plot["y"]) or 1 for key in keys]
    for y in plot["y"]:
        widths = [(cell(*key, y) or (0,))[0] for key in keys]
        if plot.get("share"):
            widths = [100 * width / whole for width, whole in zip(widths, wholes)]
        axis.barh([" ".join(key).strip() for key in keys], widths, left=left, label=y)
        left = [a + b for a, b in zip(left, widths)]
    axis.invert_yaxis()
    axis.set(title=plot["title"], xlabel="%" if plot.get("share") else "")
    axis.legend()
    return figure


def histogram(plot):
    records = [json.loads(line) for path in sorted(HERE.glob("records*.jsonl"))
               for line in path.read_text(encoding="utf-8").splitlines()]
    figure, axes = plt.subplots(1, max(1, len(DATASETS)), squeeze=False, figsize=(4 * max(1, len(DATASETS)), 3))
    for axis, dataset in zip(axes[0], DATASETS):
        for series in plot["series"]:
            for record in records:
                if (record["dataset"], record["variant"], record["status"]) != (dataset, series["members"][0], "done"):
                    continue
                counts = record
                for key in plot["value"].split("."):
                    counts = counts[key]
                axis.stairs(counts, [i * plot["bin_width"] for i in range(len(counts) + 1)], label=series["name"])
                break
        axis.set(title=dataset, xlabel=plot["x_label"])
    axes[0][0].legend()
    return figure


def overview():
    """A panel for each metric with numbers."""
    metrics = [one["metric"] for one in ROWS[0]["cells"] if "median" in one] if ROWS else []
    names = [f'{row["dataset"]} {row.get("variant", "")}'.strip() for row in ROWS]
    figure, axes = plt.subplots(1, max(1, len(metrics)), squeeze=False, sharey=True,
                                figsize=(3 * max(1, len(metrics)), 1 + 0.3 * len(ROWS)))
    for axis, metric in zip(axes[0], metrics):
        cells = [cell(row["dataset"], row.get("variant", ""), metric) for row in ROWS]
        axis.barh(names, [one[0] if one else 0 for one in cells],
                  xerr=[[one[0] - one[1] if one else 0 for one in cells], [one[2] - one[0] if one else 0 for one in cells]])
        axis.set_title(metric, fontsize=8)
    axes[0][0].invert_yaxis()
    return figure


DRAWN = {"curve": curve, "bars": bars, "histogram": histogram}
FIGURES = [(plot["name"], DRAWN[plot["kind"]](plot)) for plot in PLOTS] or [("table", overview())]
for name, figure in FIGURES:
    figure.tight_layout()
    figure.savefig(HERE / f"{name}.pdf")
)py";

}  // namespace

std::string table_script(const Experiment& experiment) {
  // JSON is Python but for three words.
  std::string plots = plots_to_json(experiment.plots).dump(1);
  const auto replace_all = [&plots](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = plots.find(from, at)) != std::string::npos; at += to.size()) {
      plots.replace(at, from.size(), to);
    }
  };
  replace_all(": true", ": True");
  replace_all(": false", ": False");
  return "#!/usr/bin/env python3\n\"\"\"Draws table.json beside it with matplotlib, as PDF. Written by deliso; change "
         "it "
         "as you like.\"\"\"\nPLOTS = " +
         plots + "\n\n" + kScript;
}

}  // namespace deliso
