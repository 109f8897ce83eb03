#include "experiments/commands/stated_options.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "delaunay/base/check.h"
#include "experiments/commands/world.h"
#include "experiments/config/config.h"

namespace deliso {
namespace {

struct Statement {
  std::string text;  // as typed
  std::string_view key;
  ParameterValue value;
};

// Adds what every option states that was given; its value is among the parameters already. An option that stands for a
// parameter has its line here.
void append_options(const StatedOptions& stated, const Parameters& parameters, std::vector<Statement>& statements) {
  const auto add = [&](const std::string& text, std::string_view key) {
    statements.push_back({text, key, find_parameter(key)->get(parameters)});
  };
  const auto add_value = [&](const std::string& option, const std::string& typed, std::string_view key) {
    if (!typed.empty()) add(std::string(option).append(1, ' ').append(typed), key);
  };
  const auto add_flag = [&](const std::string& option, bool is_given, std::string_view key) {
    if (is_given) add(option, key);
  };
  add_flag("--closed", stated.closed, "boundary");
  add_value("--label", stated.field.label, "field.label");
  add_value("--smooth", stated.field.smooth, "field.smooth");
  add_flag("--invert", stated.field.invert, "field.invert");

  const SizeOptions& sizes = stated.sizes;
  add_value("--max-error", sizes.max_error, "size.max_error");
  add_value("--max-edge", sizes.max_edge, "size.max_edge");
  add_value("--min-angle", sizes.min_angle, "size.min_angle");
  add_value("--max-aspect", sizes.max_aspect, "size.max_aspect");
  add_value("--target-vertices", sizes.target_vertices, "size.target_vertices");
  add_value("--keep-largest", sizes.keep_largest, "components.keep_largest");
  add_value("--min-component", sizes.min_component,
            sizes.min_component.starts_with("area:")     ? "components.min_area"
            : sizes.min_component.starts_with("volume:") ? "components.min_volume"
                                                         : "components.min_vertices");
  add_flag("--fill-cavities", sizes.fill_cavities, "components.fill_cavities");
  for (const std::string_view key : {"region.i0", "region.i1", "region.j0", "region.j1", "region.k0", "region.k1"})
    add_value("--region", sizes.region, key);
}

bool is_in_world_units(std::string_view text) {
  const std::size_t end = text.find_last_not_of("23");
  return end != std::string_view::npos && (text[end] == 'w' || text.substr(0, end + 1).ends_with("mm"));
}

}  // namespace

void check_agreement(const StatedOptions& stated, const Volume* volume, const Parameters& parameters) {
  std::vector<Statement> statements;
  for (const std::string& assignment : stated.assignments) {
    Parameters one;
    set_parameter(with_length_in_voxels(assignment, volume), one);
    const ParameterField* field = find_parameter(std::string_view(assignment).substr(0, assignment.find('=')));
    statements.push_back({"--set " + assignment, field->path, field->get(one)});
  }
  append_options(stated, parameters, statements);
  if (volume == nullptr) std::erase_if(statements, [](const Statement& s) { return is_in_world_units(s.text); });
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const Statement& later = statements[i];
    for (std::size_t j = 0; j < i; ++j) {
      const Statement& earlier = statements[j];
      if (earlier.key != later.key || earlier.value == later.value) continue;
      throw InputError(later.text + ": states another " + std::string(later.key) + " than " + earlier.text +
                       ", expected one value; leave one of the two out");
    }
  }
}

}  // namespace deliso
