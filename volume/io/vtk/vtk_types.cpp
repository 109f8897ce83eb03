#include "volume/io/vtk/vtk_types.h"

#include <algorithm>
#include <map>
#include <string>

namespace deliso {

std::optional<StoredType> legacy_vtk_type(std::string_view name) {
  static const std::map<std::string, StoredType> kTypes{
      {"unsigned_char", StoredType::kU8}, {"char", StoredType::kI8},
      {"signed_char", StoredType::kI8},   {"unsigned_short", StoredType::kU16},
      {"short", StoredType::kI16},        {"unsigned_int", StoredType::kU32},
      {"int", StoredType::kI32},          {"unsigned_long", StoredType::kU64},
      {"long", StoredType::kI64},         {"float", StoredType::kF32},
      {"double", StoredType::kF64},       {"vtkidtype", StoredType::kI32},
      {"vtktypeint64", StoredType::kI64}, {"vtktypeuint64", StoredType::kU64}};
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const auto type = kTypes.find(lower);
  return type == kTypes.end() ? std::nullopt : std::optional(type->second);
}

std::optional<StoredType> xml_vtk_type(std::string_view name) {
  static const std::map<std::string_view, StoredType> kTypes{
      {"UInt8", StoredType::kU8},   {"Int8", StoredType::kI8},    {"UInt16", StoredType::kU16},
      {"Int16", StoredType::kI16},  {"UInt32", StoredType::kU32}, {"Int32", StoredType::kI32},
      {"UInt64", StoredType::kU64}, {"Int64", StoredType::kI64},  {"Float32", StoredType::kF32},
      {"Float64", StoredType::kF64}};
  const auto type = kTypes.find(name);
  return type == kTypes.end() ? std::nullopt : std::optional(type->second);
}

}  // namespace deliso
