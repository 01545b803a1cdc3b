#include <pairsum/files/hdf5_file.hpp>

#include <algorithm>
#include <array>

#include <pairsum/core/error.hpp>
#include <pairsum/core/memory.hpp>
#include <pairsum/particles/particle_table.hpp>

namespace pairsum::files {
namespace {

constexpr hssize_t most_numbers = 64;
constexpr std::size_t longest_text = 1 << 16;
constexpr hsize_t rows_at_once = 1 << 16;    ///< that are read before they go to their columns
constexpr hsize_t most_deflated = 1100;      ///< bytes that deflate may make of one; 1032 at most
constexpr double bytes_per_row = 200;        ///< that reading takes, both processes together
constexpr double most_idle_bytes = 1 << 26;  ///< of a chunk that rows do not fill

/// As HDF5 calls it; the root has a name of its own.
const char* named(const std::string& object) { return object.empty() ? "/" : object.c_str(); }

hid_t open_quietly(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  return H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
}

/// The rows of a chunk; 0 where a dataset has none.
hsize_t rows_of_chunk(hid_t dataset) {
  const hdf5_handle made(H5Dget_create_plist(dataset), H5Pclose);
  std::array<hsize_t, H5S_MAX_RANK> chunk{};
  if (H5Pget_layout(made) != H5D_CHUNKED) return 0;
  return H5Pget_chunk(made, H5S_MAX_RANK, chunk.data()) > 0 ? chunk[0] : 0;
}

}  // namespace

std::string hdf5_last_words() {
  std::string words;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* e, void* to) -> herr_t {
        if (n == 0 && e->desc != nullptr) *static_cast<std::string*>(to) = e->desc;
        return 0;
      },
      &words);
  std::ranges::replace_if(
      words, [](unsigned char c) { return c < ' '; }, ' ');
  return words.empty() ? "HDF5 says no more" : words;
}

void hdf5_file::fail(const std::string& object, const std::string& why) const {
  throw error(path_ + (object.empty() ? "" : ": " + object) + ": " + why);
}

hdf5_file::hdf5_file(std::string path) : path_(std::move(path)), file_(open_quietly(path_), H5Fclose) {
  if (!file_) fail("", "cannot be opened as HDF5: " + hdf5_last_words());
}

bool hdf5_file::has(const std::string& object) const {
  for (std::size_t slash = object.find('/'); slash != object.npos; slash = object.find('/', slash + 1))
    if (H5Lexists(file_, object.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return !object.empty() && H5Lexists(file_, object.c_str(), H5P_DEFAULT) > 0 &&
         H5Oexists_by_name(file_, object.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> hdf5_file::names(const std::string& group) const {
  std::vector<std::string> all;
  if (!group.empty() && !has(group)) return all;
  const hdf5_handle opened(H5Gopen2(file_, named(group), H5P_DEFAULT), H5Gclose);
  if (!opened) return all;
  H5Literate(
      opened, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
        static_cast<std::vector<std::string>*>(to)->emplace_back(name);
        return 0;
      },
      &all);
  return all;
}

std::optional<std::vector<double>> hdf5_file::numbers(const std::string& object, const std::string& attribute) const {
  const hdf5_handle opened(H5Aopen_by_name(file_, named(object), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
  if (!opened) return {};
  const hdf5_handle type(H5Aget_type(opened), H5Tclose), space(H5Aget_space(opened), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type);
  const hssize_t n = H5Sget_simple_extent_npoints(space);
  if ((kind != H5T_INTEGER && kind != H5T_FLOAT) || n < 1 || n > most_numbers) return {};
  std::vector<double> all(static_cast<std::size_t>(n));
  if (H5Aread(opened, H5T_NATIVE_DOUBLE, all.data()) < 0)
    fail(object, "cannot read " + attribute + ": " + hdf5_last_words());
  return all;
}

std::optional<std::string> hdf5_file::text(const std::string& object, const std::string& attribute) const {
  const hdf5_handle opened(H5Aopen_by_name(file_, named(object), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
  if (!opened) return {};
  const hdf5_handle type(H5Aget_type(opened), H5Tclose), space(H5Aget_space(opened), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return {};
  if (H5Tis_variable_str(type) > 0) {
    char* read = nullptr;
    if (H5Aread(opened, type, static_cast<void*>(&read)) < 0 || read == nullptr) return {};
    const std::string copy(read);
    H5free_memory(read);
    return copy;
  }
  const std::size_t size = H5Tget_size(type);
  if (size > longest_text) return {};
  std::string read(size, '\0');
  if (H5Aread(opened, type, read.data()) < 0) return {};
  read.resize(std::min(read.find('\0'), size));
  return read;
}

hdf5_handle hdf5_file::open(const std::string& dataset) const {
  hdf5_handle opened(H5Dopen2(file_, named(dataset), H5P_DEFAULT), H5Dclose);
  if (!opened) fail(dataset, "is no dataset that HDF5 can open: " + hdf5_last_words());
  return opened;
}

hdf5_file::shape hdf5_file::shape_of(const std::string& dataset) const {
  const hdf5_handle opened = open(dataset);
  const hdf5_handle type(H5Dget_type(opened), H5Tclose), space(H5Dget_space(opened), H5Sclose),
      made(H5Dget_create_plist(opened), H5Pclose);
  if (const H5T_class_t kind = H5Tget_class(type); kind != H5T_INTEGER && kind != H5T_FLOAT)
    fail(dataset, "holds no numbers, should hold integers or floating-point numbers");
  std::array<hsize_t, H5S_MAX_RANK> extent{}, chunk{};
  const int rank = H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  if (rank != 1 && rank != 2)
    fail(dataset, "has " + std::to_string(rank) + " dimensions, should have 1 (N) or 2 (N x 1 to 3)");
  const hsize_t columns = rank == 2 ? extent[1] : 1;
  if (columns < 1 || columns > 3) fail(dataset, "has " + std::to_string(columns) + " columns, should have 1, 2 or 3");
  if (extent[0] > most_particles)
    fail(dataset, "has " + std::to_string(extent[0]) + " rows, more than the " + std::to_string(most_particles) +
                      " particles that pairsum counts");
  if (H5Pget_layout(made) == H5D_VIRTUAL || H5Pget_external_count(made) > 0)
    fail(dataset, "keeps its rows in other files; give those");
  const double bytes = static_cast<double>(extent[0] * columns * H5Tget_size(type));
  const auto stored = static_cast<double>(H5Dget_storage_size(opened));
  hsize_t size = 0;
  H5Fget_filesize(file_, &size);
  if (stored > static_cast<double>(size) || bytes > stored * most_deflated)
    fail(dataset, "claims " + std::to_string(extent[0]) + " rows, which its file of " + std::to_string(size) +
                      " bytes cannot hold; it is damaged, or was never filled");
  if (H5Pget_layout(made) == H5D_CHUNKED && H5Pget_chunk(made, H5S_MAX_RANK, chunk.data()) == rank) {
    double one = static_cast<double>(H5Tget_size(type));
    for (int d = 0; d < rank; ++d) one *= static_cast<double>(chunk[static_cast<std::size_t>(d)]);
    if (one > 4 * bytes + most_idle_bytes) fail(dataset, "has chunks many times as large as all its rows");
  }
  check_memory(static_cast<double>(extent[0]) * bytes_per_row, path_ + ": " + dataset, "fewer particles take less");
  return {static_cast<std::size_t>(extent[0]), static_cast<std::size_t>(columns)};
}

void hdf5_file::read(const std::string& dataset, std::span<const std::size_t> which,
                     std::span<double* const> to) const {
  const auto [rows, columns] = shape_of(dataset);
  const hdf5_handle opened = open(dataset), space(H5Dget_space(opened), H5Sclose);
  const auto check = [&](herr_t done) {
    if (done < 0) fail(dataset, "cannot be read: " + hdf5_last_words());
  };
  if (columns == 1) return check(H5Dread(opened, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to[0]));
  const hsize_t chunk = std::max<hsize_t>(rows_of_chunk(opened), 1);
  const hsize_t at_once = std::min<hsize_t>(std::max<hsize_t>(rows_at_once / chunk, 1) * chunk, rows);
  std::vector<double> block(at_once * columns);
  for (hsize_t begin = 0; begin < rows; begin += at_once) {
    const std::array<hsize_t, 2> first{begin, 0}, count{std::min<hsize_t>(at_once, rows - begin), columns};
    const hdf5_handle memory(H5Screate_simple(2, count.data(), nullptr), H5Sclose);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr));
    check(H5Dread(opened, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, block.data()));
    for (std::size_t k = 0; k < which.size(); ++k)
      for (hsize_t i = 0; i < count[0]; ++i) to[k][begin + i] = block[i * columns + which[k]];
  }
}

}  // namespace pairsum::files
