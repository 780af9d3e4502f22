#include "common/io/hdf5.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::io {

namespace {

/// Owner of an HDF5 handle of any kind.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

/// HDF5 would print its own error stack; errors here are exceptions. After a file that could not be written
/// (full disk) its clean-up at the program's exit would crash; every file is closed by its owner, so nothing
/// is left for it to do.
void prepare() {
  static const bool once = H5dont_atexit() >= 0;
  static_cast<void>(once);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw OutputFailed(fmt::format(
      "'{}': {}; check that the file is an HDF5 file of this run and that the disk has space", path, what));
}

void require(bool good, const std::string& path, const std::string& what) {
  if (!good) fail(path, what);
}

Handle open_dataset(hid_t id, const std::string& path, const std::string& name) {
  Handle dataset(H5Dopen2(id, name.c_str(), H5P_DEFAULT), H5Dclose);
  require(static_cast<bool>(dataset), path, fmt::format("there is no dataset '{}'", name));
  return dataset;
}

std::vector<std::uint64_t> shape_of(const Handle& dataset) {
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

/// Rows that are compressed, or made, at a time.
constexpr hsize_t rows_of_a_piece = 32;

/// Rows in pieces that are compressed, fast rather than well.
void deflate(const Handle& properties, std::vector<hsize_t> extent) {
  constexpr unsigned fast = 1;
  if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) <= 0) return;
  extent.front() = std::min(extent.front(), rows_of_a_piece);
  H5Pset_chunk(properties.get(), static_cast<int>(extent.size()), extent.data());
  H5Pset_shuffle(properties.get());
  H5Pset_deflate(properties.get(), fast);
}

void write_scalar(hid_t id, const std::string& path, const std::string& name, hid_t type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(id, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(attribute && H5Awrite(attribute.get(), type, value) >= 0, path,
          fmt::format("cannot write the attribute '{}'", name));
}

Handle open_attribute(hid_t id, const std::string& path, const std::string& name) {
  Handle attribute(H5Aopen(id, name.c_str(), H5P_DEFAULT), H5Aclose);
  require(static_cast<bool>(attribute), path, fmt::format("there is no attribute '{}'", name));
  return attribute;
}

}  // namespace

Hdf5 Hdf5::create(const std::string& path) {
  prepare();
  const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (id < 0) {
    throw OutputFailed(
        fmt::format("cannot create '{}'; check the directory, its permissions and the free space", path));
  }
  return {path, id, true};
}

Hdf5 Hdf5::open(const std::string& path) {
  prepare();
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) {
    throw OutputFailed(fmt::format("cannot open '{}'; check that it exists and is an HDF5 file", path));
  }
  return {path, id, true};
}

Hdf5::Hdf5(Hdf5&& other) noexcept
    : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)), is_file_(other.is_file_) {}

Hdf5& Hdf5::operator=(Hdf5&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(id_, other.id_);
  std::swap(is_file_, other.is_file_);
  return *this;
}

Hdf5::~Hdf5() {
  if (id_ < 0) return;
  if (is_file_) {
    H5Fclose(id_);
  } else {
    H5Gclose(id_);
  }
}

void Hdf5::close() {
  const hid_t id = std::exchange(id_, -1);
  if (id < 0) return;
  const bool flushed = !is_file_ || H5Fflush(id, H5F_SCOPE_LOCAL) >= 0;
  const bool closed = (is_file_ ? H5Fclose(id) : H5Gclose(id)) >= 0;
  require(flushed && closed, path_, "cannot write the last of it");
}

Hdf5 Hdf5::make_group(const std::string& name) {
  const hid_t id = H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  require(id >= 0, path_, fmt::format("cannot create the group '{}'", name));
  return {path_, id, false};
}

Hdf5 Hdf5::group(const std::string& name) const {
  const hid_t id = H5Gopen2(id_, name.c_str(), H5P_DEFAULT);
  require(id >= 0, path_, fmt::format("there is no group '{}'", name));
  return {path_, id, false};
}

void Hdf5::link(const std::string& name, const std::string& file, const std::string& target) {
  const herr_t status =
      H5Lcreate_external(file.c_str(), target.c_str(), id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  require(status >= 0, path_, fmt::format("cannot link '{}' to '{}'", name, file));
}

std::int64_t Hdf5::make_dataset(const std::string& name, std::int64_t type,
                                std::span<const std::uint64_t> shape, Packing packing) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const Handle space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
  const Handle timeless(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);  // same values, same file
  H5Pset_obj_track_times(timeless.get(), false);
  if (packing == Packing::deflated) deflate(timeless, extent);
  return H5Dcreate2(id_, name.c_str(), type, space.get(), H5P_DEFAULT, timeless.get(), H5P_DEFAULT);
}

void Hdf5::write_values(const std::string& name, const Values& values, std::span<const std::uint64_t> shape,
                        Packing packing) {
  const auto expected = std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
  if (expected != values.count) {
    throw std::logic_error(fmt::format("dataset '{}': {} values do not fill its shape", name, values.count));
  }
  const Handle dataset(make_dataset(name, values.in_file, shape, packing), H5Dclose);
  require(
      dataset && H5Dwrite(dataset.get(), values.in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data) >= 0,
      path_, fmt::format("cannot write the dataset '{}'", name));
}

void Hdf5::write(const std::string& name, std::span<const double> values,
                 std::span<const std::uint64_t> shape, Packing packing) {
  write_values(name, {values.data(), values.size(), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE}, shape, packing);
}

void Hdf5::write(const std::string& name, std::span<const std::uint8_t> values,
                 std::span<const std::uint64_t> shape, Packing packing) {
  write_values(name, {values.data(), values.size(), H5T_STD_U8LE, H5T_NATIVE_UINT8}, shape, packing);
}

void Hdf5::write(const std::string& name, std::span<const std::uint64_t> shape, Packing packing,
                 const std::function<std::vector<double>(std::uint64_t first, std::uint64_t end)>& make) {
  const Handle dataset(make_dataset(name, H5T_IEEE_F64LE, shape, packing), H5Dclose);
  const std::string what = fmt::format("cannot write the dataset '{}'", name);
  require(static_cast<bool>(dataset), path_, what);
  const Handle in_file(H5Dget_space(dataset.get()), H5Sclose);
  std::vector<hsize_t> count(shape.begin(), shape.end()), start(shape.size(), 0);
  for (std::uint64_t first = 0; first < shape.front(); first += rows_of_a_piece) {
    const std::uint64_t end = std::min<std::uint64_t>(first + rows_of_a_piece, shape.front());
    start.front() = first;
    count.front() = end - first;
    const std::vector<double> values = make(first, end);
    const Handle in_memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
    if (std::cmp_not_equal(H5Sget_simple_extent_npoints(in_memory.get()), values.size()))
      throw std::logic_error(
          fmt::format("dataset '{}': {} values do not fill its rows", name, values.size()));
    const bool chosen =
        H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0;
    require(chosen && H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, in_memory.get(), in_file.get(), H5P_DEFAULT,
                               values.data()) >= 0,
            path_, what);
  }
}

void Hdf5::write(const std::string& name, std::span<const double> values) {
  const std::uint64_t size = values.size();
  write(name, values, {&size, 1});
}

Array Hdf5::read(const std::string& name) const {
  const Handle dataset = open_dataset(id_, path_, name);
  Array array{.shape = shape_of(dataset), .values = {}};
  array.values.resize(
      std::accumulate(array.shape.begin(), array.shape.end(), std::uint64_t{1}, std::multiplies<>()));
  require(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) >= 0,
          path_, fmt::format("cannot read the dataset '{}'", name));
  return array;
}

void Hdf5::write_attribute(const std::string& name, double value) {
  write_scalar(id_, path_, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5::write_attribute(const std::string& name, std::uint64_t value) {
  write_scalar(id_, path_, name, H5T_NATIVE_UINT64, &value);
}

void Hdf5::write_attribute(const std::string& name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(1, value.size()));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  write_scalar(id_, path_, name, type.get(), value.data());
}

double Hdf5::number_attribute(const std::string& name) const {
  const Handle attribute = open_attribute(id_, path_, name);
  double value = 0;
  require(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) >= 0, path_,
          fmt::format("cannot read the attribute '{}'", name));
  return value;
}

std::string Hdf5::text_attribute(const std::string& name) const {
  const Handle attribute = open_attribute(id_, path_, name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  std::string value(H5Tget_size(type.get()), '\0');
  require(H5Aread(attribute.get(), type.get(), value.data()) >= 0, path_,
          fmt::format("cannot read the attribute '{}'", name));
  value.resize(std::min(value.find('\0'), value.size()));
  return value;
}

bool Hdf5::has_attribute(const std::string& name) const {
  return H5Aexists(id_, name.c_str()) > 0;
}

bool Hdf5::has(const std::string& name) const {
  for (auto slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
    if (slash > 0 && H5Lexists(id_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(id_, name.c_str(), H5P_DEFAULT) > 0 &&
         H5Oexists_by_name(id_, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::uint64_t> Hdf5::shape(const std::string& name) const {
  return shape_of(open_dataset(id_, path_, name));
}

std::vector<std::string> Hdf5::names() const {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  const herr_t status = H5Literate(id_, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
  require(status >= 0, path_, "cannot list a group");
  return names;
}

}  // namespace fsi::io
