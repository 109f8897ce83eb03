// The variants of an experiment as JSON: the base, what each changes of it, and the sweep.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/strict_object.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// What the variants are made from; paths in it are relative to `folder`.
Variant parse_base(const StrictObject& experiment, const std::filesystem::path& folder, Mistakes& mistakes);

// Every variant with every combination of the sweep. Throws InputError where the names of the variants cannot be known;
// other mistakes are gathered. Paths are relative to `folder`.
std::vector<Variant> parse_all_variants(const StrictObject& experiment, const Variant& base,
                                        const std::filesystem::path& folder, Mistakes& mistakes);

// The variant of this name; fails at the key of `object` where there is none.
const Variant& find_variant(const std::string& name, const std::vector<Variant>& variants, const StrictObject& object,
                            std::string_view key);

// For parse_all_variants to read back: each with all in which it differs from the base.
Json variants_to_json(const Experiment& experiment);

}  // namespace deliso
