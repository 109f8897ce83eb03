// Values as columns, which pack well: what is alike stands together, and whole numbers stand in bytes. The page makes
// the values of them again (space/columns.js).
//
// A column of n values is one of
//   {"same": v}                        n times v
//   {"ints": text}                     whole numbers: how many bytes each has, then in base 64 all lowest bytes, all
//                                      second ones, and so on; a number k stands as 2 k, or as -2 k - 1 below 0
//   {"scaled": s, "ints": text}        numbers, times s
//   {"parts": [column, ...]}           arrays of as many parts: a column for each
//   {"sizes": column, "items": column} arrays: how long each is, and all their items
//   {"values": [...]}                  as they are
// A list is {"count": n, "column": column}. Objects stand by kinds, each with keys of its own: {"order": list of kinds,
// "kinds": [{"count": n, "columns": {key: column, ...}}, ...]}.
#pragma once

#include "experiments/config/json.h"

namespace deliso {

// Of a list of values that are no objects.
Json list_of_values(const Json& values);

// Of a list of objects, in their order.
Json list_of_objects(const Json& objects);

}  // namespace deliso
