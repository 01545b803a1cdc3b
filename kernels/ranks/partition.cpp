#include <pairsum/ranks/partition.hpp>

#include <exception>
#include <limits>
#include <string>

#include <mpi.h>
#include <zoltan.h>

#include <pairsum/core/error.hpp>

namespace pairsum::ranks {
namespace {

void check(int code, const char* what) {
  if (code != ZOLTAN_OK && code != ZOLTAN_WARN)
    throw error(std::string("Zoltan could not ") + what + " (code " + std::to_string(code) + ")");
}

const weighted_points& points_of(void* data) { return *static_cast<const weighted_points*>(data); }

int number_of_points(void* data, int* ierr) {
  *ierr = ZOLTAN_OK;
  return static_cast<int>(points_of(data).x.size());
}
void list_points(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float* weights, int* ierr) {
  const weighted_points& p = points_of(data);
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    global[k] = local[k] = static_cast<ZOLTAN_ID_TYPE>(k);
    weights[k] = p.weight[k];
  }
  *ierr = ZOLTAN_OK;
}
int dimensions(void* data, int* ierr) {
  *ierr = ZOLTAN_OK;
  return points_of(data).dim;
}
void coordinates(void* data, int, int, int n, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int dim, double* x, int* ierr) {
  const weighted_points& p = points_of(data);
  for (int k = 0; k < n; ++k)
    for (int d = 0; d < dim; ++d) x[k * dim + d] = p.x[local[k]][static_cast<std::size_t>(d)];
  *ierr = ZOLTAN_OK;
}

}  // namespace

partition::partition() {
  float version = 0;
  check(Zoltan_Initialize(0, nullptr, &version), "start");
  zoltan_ = Zoltan_Create(MPI_COMM_WORLD);
  if (zoltan_ == nullptr) throw error("Zoltan could not start");
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  rank_box all, none;
  all.low.fill(-infinite), all.high.fill(infinite);
  none.low.fill(infinite), none.high.fill(-infinite);
  boxes_.assign(static_cast<std::size_t>(ranks), none);
  boxes_[0] = all;
  for (const auto& [name, value] :
       {std::array{"DEBUG_LEVEL", "0"}, std::array{"LB_METHOD", "RCB"}, std::array{"KEEP_CUTS", "1"},
        std::array{"RCB_REUSE", "1"}, std::array{"RETURN_LISTS", "NONE"}, std::array{"OBJ_WEIGHT_DIM", "1"},
        std::array{"RCB_OUTPUT_LEVEL", "0"}, std::array{"IMBALANCE_TOL", "1.01"}})
    check(Zoltan_Set_Param(zoltan_, name, value), "take its parameters");
}

partition::~partition() {
  // Collective: after an error on one rank the others are elsewhere.
  if (std::uncaught_exceptions() == 0) Zoltan_Destroy(&zoltan_);
}

void partition::cut(const weighted_points& own) {
  unsigned long long points = own.x.size();
  MPI_Allreduce(MPI_IN_PLACE, &points, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
  // Zoltan finds no cuts then: the last ones stay. The only rank has everything, not the empty box that Zoltan tells.
  if (points == 0 || boxes_.size() == 1) return;
  has_cuts_ = true;
  void* const data = const_cast<weighted_points*>(&own);
  Zoltan_Set_Num_Obj_Fn(zoltan_, number_of_points, data);
  Zoltan_Set_Obj_List_Fn(zoltan_, list_points, data);
  Zoltan_Set_Num_Geom_Fn(zoltan_, dimensions, data);
  Zoltan_Set_Geom_Multi_Fn(zoltan_, coordinates, data);
  int changes, gid, lid, imports, exports, *import_procs, *import_parts, *export_procs, *export_parts;
  ZOLTAN_ID_PTR import_global, import_local, export_global, export_local;
  check(Zoltan_LB_Partition(zoltan_, &changes, &gid, &lid, &imports, &import_global, &import_local, &import_procs,
                            &import_parts, &exports, &export_global, &export_local, &export_procs, &export_parts),
        "partition the domain");
  constexpr double far = std::numeric_limits<double>::max() / 2, infinite = std::numeric_limits<double>::infinity();
  for (int rank = 0; rank < static_cast<int>(boxes_.size()); ++rank) {
    auto& [low, high] = boxes_[static_cast<std::size_t>(rank)];
    int dim = 0;
    check(Zoltan_RCB_Box(zoltan_, rank, &dim, &low[0], &low[1], &low[2], &high[0], &high[1], &high[2]),
          "tell a rank's box");
    for (std::size_t d = 0; d < 3; ++d) {
      if (low[d] < -far || static_cast<int>(d) >= dim) low[d] = -infinite;
      if (high[d] > far || static_cast<int>(d) >= dim) high[d] = infinite;
    }
  }
}

int partition::rank_of(const std::array<double, 3>& x) const {
  std::array<double, 3> at = x;
  int rank = 0;
  if (!has_cuts_) return rank;
  check(Zoltan_LB_Point_Assign(zoltan_, at.data(), &rank), "find the rank of a point");
  return rank;
}

}  // namespace pairsum::ranks
