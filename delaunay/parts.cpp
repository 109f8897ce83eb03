// Parts of a triangulation, by which several threads insert at the same time.
#include "delaunay/base/check.h"
#include "delaunay/base/parallel.h"
#include "delaunay/bowyer_watson.h"

namespace deliso {

std::vector<PartRoom> BowyerWatson::make_rooms(std::span<const Slab> slabs, std::size_t insertions, int threads,
                                               double tets_per_insertion) {
  // Free slots are distributed; new ones are made for the rest.
  const std::size_t count = slabs.size();
  const auto expected = static_cast<std::size_t>(tets_per_insertion * static_cast<double>(insertions));
  const std::size_t wanted = expected + kFewestLeft;
  const std::size_t least_free = free_.size() / count;
  const std::size_t created = wanted > least_free ? wanted - least_free : 0;
  const std::size_t vertices = points_.size(), tets = tets_.size();
  if (tets + count * created > kMostTets) return {};
  // Two arrays at the same time: most of the time goes into waiting for fresh pages.
  const int threads_each = (threads + 1) / 2;
  run_tasks(2, threads, [&](std::size_t task) {
    if (task == 0) {
      tets_.make_room(tets + count * created, threads_each);
    } else {
      points_.make_room(vertices + count * insertions, threads_each);
      incident_.make_room(vertices + count * insertions, threads_each);
      if (!ranks_.empty()) ranks_.make_room(vertices + count * insertions, threads_each);
    }
  });
  std::vector<PartRoom> rooms(count);
  const auto first_free = [&](std::size_t k) {
    return free_.begin() + static_cast<std::ptrdiff_t>(k * free_.size() / count);
  };
  for (std::size_t k = 0; k < count; ++k) {
    rooms[k].slab = slabs[k];
    rooms[k].vertices = {vertices + k * insertions, vertices + (k + 1) * insertions};
    rooms[k].tets = {tets + k * created, tets + (k + 1) * created};
    rooms[k].free.assign(first_free(k), first_free(k + 1));
  }
  free_.clear();
  return rooms;
}

BowyerWatson::BowyerWatson(BowyerWatson& whole, const PartRoom& room)
    : Tetrahedralization(whole, room.vertices, room.tets),
      box_(whole.box_),
      filter_(whole.filter_),
      slab_(room.slab),
      free_(room.free) {
  if (!whole.ranks_.empty()) ranks_ = SharedArray<VertexId>(whole.ranks_, room.vertices);
}

void BowyerWatson::join(BowyerWatson& part) {
  points_.take_in(part.points_);
  incident_.take_in(part.incident_);
  if (!ranks_.empty()) ranks_.take_in(part.ranks_);
  const Range skipped = tets_.take_in(part.tets_);
  free_.insert(free_.end(), part.free_.begin(), part.free_.end());
  for (std::size_t t = skipped.first; t < skipped.last; ++t) free_.emplace_back(t);
}

}  // namespace deliso
