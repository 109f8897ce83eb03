#include "volume/io/vtk/xml_tags.h"

#include <utility>

namespace deliso {

namespace {

bool is_xml_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// The five entities of XML; others stay as they are.
std::string without_entities(std::string_view text) {
  constexpr std::pair<std::string_view, char> kEntities[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
  std::string out;
  while (!text.empty()) {
    std::size_t taken = 1;
    char c = text.front();
    for (const auto& [entity, meaning] : kEntities) {
      if (!text.starts_with(entity)) continue;
      c = meaning;
      taken = entity.size();
      break;
    }
    out += c;
    text.remove_prefix(taken);
  }
  return out;
}

// name="value" pairs.
void read_attributes(const ByteStream& file, std::string_view text, XmlTag& tag) {
  while (true) {
    while (!text.empty() && is_xml_blank(text.front())) text.remove_prefix(1);
    if (text.empty()) return;
    const std::size_t equals = text.find('=');
    std::string_view name = text.substr(0, equals);
    while (!name.empty() && is_xml_blank(name.back())) name.remove_suffix(1);
    if (equals == std::string_view::npos) file.fail("the attribute " + in_quotes(name) + " has no value");
    text.remove_prefix(equals + 1);
    while (!text.empty() && is_xml_blank(text.front())) text.remove_prefix(1);
    const char quote = text.empty() ? ' ' : text.front();
    const std::size_t end = quote == '"' || quote == '\'' ? text.find(quote, 1) : std::string_view::npos;
    if (end == std::string_view::npos) file.fail("the attribute " + in_quotes(name) + " has no value in quotes");
    tag.attributes[std::string(name)] = without_entities(text.substr(1, end - 1));
    text.remove_prefix(end + 1);
  }
}

// Where a tag ends: at the first > that stands in no quotes.
std::size_t end_of_tag(std::string_view text) {
  std::size_t place = 0;
  while ((place = text.find_first_of("\"'>", place)) != std::string_view::npos && text[place] != '>') {
    place = text.find(text[place], place + 1);
    if (place == std::string_view::npos) break;
    ++place;
  }
  return place;
}

}  // namespace

std::optional<XmlTag> next_xml_tag(const ByteStream& file, std::string_view text, std::size_t position) {
  while (true) {
    position = text.find('<', position);
    if (position == std::string_view::npos) return std::nullopt;
    const std::string_view rest = text.substr(position);
    const std::string_view ending = rest.starts_with("<!--") ? "-->" : rest.starts_with("<?") ? "?>" : ">";
    const bool has_attributes = ending == ">" && !rest.starts_with("<!");
    const std::size_t end = has_attributes ? end_of_tag(rest) : rest.find(ending);
    if (end == std::string_view::npos)
      file.fail("the tag " + in_quotes(rest.substr(0, rest.find('\n'))) + " does not end");
    position += end + ending.size();
    if (rest[1] == '?' || rest[1] == '!') continue;
    XmlTag tag;
    tag.end = position;
    std::string_view inside = rest.substr(1, end - 1);
    if (!inside.empty() && inside.back() == '/') {
      tag.is_closed = true;
      inside.remove_suffix(1);
    }
    std::size_t length = 0;
    while (length < inside.size() && !is_xml_blank(inside[length])) ++length;
    tag.name = inside.substr(0, length);
    read_attributes(file, inside.substr(length), tag);
    return tag;
  }
}

}  // namespace deliso
