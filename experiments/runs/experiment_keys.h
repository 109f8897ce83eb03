// The keys of an experiment and of its parts: the parser and the schema are made from these tables.
#pragma once

#include <array>
#include <string_view>

#include "experiments/config/strict_object.h"

namespace deliso {

inline constexpr double kMostRepeats = 10000;
inline constexpr double kLargestSeed = 0x1p53;
inline constexpr std::array<std::string_view, 2> kTaskNames = {"mesh", "topology"};
inline constexpr std::array<std::string_view, 2> kRowNames = {"runs", "datasets"};
inline constexpr std::array<std::string_view, 2> kMesherNames = {"deliso", "marching_cubes"};
inline constexpr std::array<std::string_view, 3> kPlotKindNames = {"curve", "bars", "histogram"};
inline constexpr std::array<std::string_view, 2> kAcrossNames = {"variants", "datasets"};
inline constexpr std::array<std::string_view, 2> kAxisNames = {"x", "y"};
inline constexpr std::array<std::string_view, 5> kRelationNames = {"equal", "below", "above", "at_most", "at_least"};

inline constexpr std::array kExperimentKeys = {
    KeyInfo{"name", KeyType::kText, false, "of the experiment in its records; default: the file's name"},
    KeyInfo{"title", KeyType::kText, true, "stands above the table"},
    KeyInfo{"question", KeyType::kText, false, "what the table answers"},
    KeyInfo{"notes", KeyType::kArray, false, "texts that stand below the question, a paragraph each"},
    KeyInfo{"answers", KeyType::kArray, false,
            "what the table shows, a paragraph each; printed by `deliso table --answers` alone"},
    choice_key("task", "what a run does: mesh the isosurface (default), or find its exact topology alone", kTaskNames),
    KeyInfo{"distances", KeyType::kBoolean, false,
            "also measure the distances between mesh and isosurface and the self-intersections"},
    KeyInfo{"manifest", KeyType::kText, false, "a file with data sets, which can then be given by name"},
    KeyInfo{"datasets", KeyType::kArray, true, "the data sets: objects, or names in the manifest"},
    KeyInfo{"builtin_datasets", KeyType::kArray, false, "the built-in fields that --builtin takes instead"},
    KeyInfo{"base", KeyType::kObject, true, "the parameters that the variants start from"},
    KeyInfo{"variants", KeyType::kArray, false, "default: the base alone"},
    KeyInfo{"sweep", KeyType::kObject, false,
            "lists of values by key path; every variant is run with every combination"},
    KeyInfo{"repeats", KeyType::kInteger, false, "runs of every data set and variant; default 1", 1, kMostRepeats},
    KeyInfo{"seed", KeyType::kInteger, false, "of the first repeat, each further one adds 1; default 1", 0,
            kLargestSeed},
    choice_key("rows", "a row of the table is a data set with a variant (runs, default) or with all of them (datasets)",
               kRowNames),
    KeyInfo{"metrics", KeyType::kArray, true, "the columns of the table"},
    KeyInfo{"plots", KeyType::kArray, false, "pictures of the table, written beside it as SVG"},
    KeyInfo{"reference", KeyType::kAny, false, "published figures: a file, or an object"},
};

inline constexpr std::array kDatasetKeys = {
    KeyInfo{"name", KeyType::kText, true, "of the data set in records and tables"},
    KeyInfo{"isovalue", KeyType::kNumber, false, "default for a built-in field: the one it suggests"},
    KeyInfo{"file", KeyType::kText, false, "looked for in the data folder"},
    KeyInfo{"also", KeyType::kText, false, "another name under which the file is taken"},
    KeyInfo{"sha256", KeyType::kText, false, "of the samples, little endian, x fastest; checked before a run"},
    KeyInfo{"get", KeyType::kText, false, "how to get the file, told where it is absent"},
    KeyInfo{"field", KeyType::kText, false, "a built-in field instead of a file"},
    KeyInfo{"size", KeyType::kInteger, false, "of the field, samples along each axis", 2, 2048},
    KeyInfo{"seed", KeyType::kInteger, false, "of the field; default 1", 0, kLargestSeed},
};

inline constexpr std::array kManifestKeys = {
    KeyInfo{"description", KeyType::kText, false, "where the data sets come from"},
    KeyInfo{"datasets", KeyType::kArray, true, "the data sets"},
};

inline constexpr std::array kBaseKeys = {
    KeyInfo{"name", KeyType::kText, true, "by which variants extend it"},
    KeyInfo{"parameters", KeyType::kAny, true, "a parameters file, or an object with what differs from the defaults"},
    KeyInfo{"set", KeyType::kObject, false, "values by key path"},
};

inline constexpr std::array kVariantKeys = {
    KeyInfo{"name", KeyType::kText, true, "of the variant in records and tables"},
    KeyInfo{"extends", KeyType::kText, false, "the base or an earlier variant; default: the base"},
    KeyInfo{"set", KeyType::kObject, false, "what it changes: values by key path"},
    KeyInfo{"mesher", KeyType::kAny, false,
            "deliso (default), marching_cubes (the baseline, on the same isosurface), or an object: another program"},
};

inline constexpr double kMostSeconds = 1e6;
inline constexpr int kLargestExitCode = 255;

inline constexpr std::array kCommandKeys = {
    KeyInfo{
        "command", KeyType::kArray, true,
        "the program, a path from this file's folder or a name in PATH, and its arguments; with {volume}, {isovalue}, "
        "{mesh}, {report}, {vertices}, {seed}, {threads}, {deliso}"},
    KeyInfo{"timeout", KeyType::kNumber, false, "seconds after which it is ended; default 600", 0.001, kMostSeconds},
    KeyInfo{"mesh_format", KeyType::kText, false, "extension of the file that it writes; default ply"},
    KeyInfo{"exit_codes", KeyType::kArray, false, "with which it has done its work; default 0"},
};

inline constexpr std::array kPlotKeys = {
    KeyInfo{"name", KeyType::kText, true, "of the file beside the table: NAME.svg"},
    KeyInfo{"title", KeyType::kText, true, "stands above the plot"},
    choice_key("kind",
               "curve: lines through points; bars: one lying bar a row of the table; histogram: counts of a record",
               kPlotKindNames, true),
    KeyInfo{"x", KeyType::kText, false, "curve: the metric along the axis of x"},
    KeyInfo{"y", KeyType::kArray, false, "curve: a row of panels for each of these metrics; bars: the parts of a bar"},
    KeyInfo{"log", KeyType::kArray, false, "curve: which axes are logarithmic, of x and y"},
    choice_key("across", "curve: what a line goes through (default: variants); the other gives a panel each",
               kAcrossNames),
    KeyInfo{"series", KeyType::kArray, false, "curve, histogram: the lines; default: one through all, one for each"},
    KeyInfo{"share", KeyType::kBoolean, false, "bars: parts in per cent of the bar's whole"},
    KeyInfo{"value", KeyType::kText, false, "histogram: where the record holds the list of counts"},
    KeyInfo{"bin_width", KeyType::kNumber, false, "histogram: of each bin, the first begins at 0", 1e-9, 1e9},
    KeyInfo{"x_label", KeyType::kText, false, "histogram: what the bins are of"},
};

inline constexpr std::array kSeriesKeys = {
    KeyInfo{"name", KeyType::kText, true, "of the line in the legend"},
    KeyInfo{"members", KeyType::kArray, true, "the variants it goes through (across datasets: the data sets)"},
};

inline constexpr std::array kMetricKeys = {
    KeyInfo{"name", KeyType::kText, true, "heads the column"},
    KeyInfo{"value", KeyType::kText, true, "where the record holds it: stages.recover.insertions"},
    KeyInfo{"per", KeyType::kText, false, "divided by this figure of the record"},
    KeyInfo{"variant", KeyType::kText, false, "taken from this variant, not from the row's"},
    KeyInfo{"over", KeyType::kText, false, "divided by the median of this variant"},
    KeyInfo{"reference", KeyType::kText, false, "column of the reference that belongs beside it"},
    KeyInfo{"ratio", KeyType::kBoolean, false, "adds a column with ours over the reference's"},
};

inline constexpr std::array kAnswerKeys = {
    KeyInfo{"text", KeyType::kText, true, "a paragraph; {DATASET|VARIANT|METRIC} stands for that figure of the table"},
    KeyInfo{"holds", KeyType::kArray, false, "what it says of the table, to be compared with the records"},
};

inline constexpr std::array kClaimKeys = {
    KeyInfo{"figure", KeyType::kText, true, "DATASET|VARIANT|METRIC, perhaps with |smallest, |median or |largest"},
    choice_key("is", "how it compares with the next, in every run", kRelationNames, true),
    KeyInfo{"than", KeyType::kAny, true, "a number, a text, or another figure in braces"},
};

inline constexpr std::array kReferenceKeys = {
    KeyInfo{"source", KeyType::kText, true, "where the figures were published"},
    KeyInfo{"rows", KeyType::kObject, true, "figures by data set and column"},
};

}  // namespace deliso
