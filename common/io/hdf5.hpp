#pragma once
/// HDF5 with owners for its handles and exceptions for its
/// errors. The only code that includes hdf5.h is hdf5.cpp.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace fsi::io {

/// Array of doubles with its shape, the last index contiguous.
struct Array {
  std::vector<std::uint64_t> shape;
  std::vector<double> values;
};

/// How the values of a dataset lie in its file.
enum class Packing { plain, deflated };

/// An open file or group of a file. Paths inside are relative to it, "a/b/c". Every member throws
/// OutputFailed with the file's path, what failed and what to look at; HDF5 itself prints nothing.
class Hdf5 {
 public:
  /// New file; what stood at `path` is lost.
  static Hdf5 create(const std::string& path);
  /// Existing file, for reading.
  static Hdf5 open(const std::string& path);

  Hdf5(Hdf5&& other) noexcept;
  Hdf5& operator=(Hdf5&& other) noexcept;
  Hdf5(const Hdf5&) = delete;
  Hdf5& operator=(const Hdf5&) = delete;
  ~Hdf5();

  Hdf5 make_group(const std::string& name);
  Hdf5 group(const std::string& name) const;
  /// Link to the object `target` of the file `file`, a path relative to this file's directory.
  void link(const std::string& name, const std::string& file, const std::string& target);

  /// `shape` is the number of values along each index, the last one contiguous.
  void write(const std::string& name, std::span<const double> values, std::span<const std::uint64_t> shape,
             Packing packing = Packing::plain);
  void write(const std::string& name, std::span<const double> values);
  /// The same with values that are made while they are written, some rows at a time: no copy of all of them need exist.
  /// `make(first, end)` gives those of the rows first .. end - 1, the first index of `shape`.
  void write(const std::string& name, std::span<const std::uint64_t> shape, Packing packing,
             const std::function<std::vector<double>(std::uint64_t first, std::uint64_t end)>& make);
  /// Small whole numbers, a byte each.
  void write(const std::string& name, std::span<const std::uint8_t> values,
             std::span<const std::uint64_t> shape, Packing packing = Packing::plain);
  Array read(const std::string& name) const;

  void write_attribute(const std::string& name, double value);
  void write_attribute(const std::string& name, std::uint64_t value);
  void write_attribute(const std::string& name, const std::string& value);
  double number_attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;
  bool has_attribute(const std::string& name) const;

  bool has(const std::string& name) const;
  /// Shape of a dataset, without reading it.
  std::vector<std::uint64_t> shape(const std::string& name) const;
  /// Names in this group, sorted.
  std::vector<std::string> names() const;
  /// Writes everything out and closes; a file that is only destroyed hides errors.
  void close();

 private:
  Hdf5(std::string path, std::int64_t id, bool is_file)
      : path_(std::move(path)), id_(id), is_file_(is_file) {}

  /// Values and the types they have, in the library's numbers.
  struct Values {
    const void* data;
    std::size_t count;
    std::int64_t in_file, in_memory;
  };

  std::string path_;
  std::int64_t id_ = -1;
  bool is_file_ = false;

  std::int64_t make_dataset(const std::string& name, std::int64_t type, std::span<const std::uint64_t> shape,
                            Packing packing);
  void write_values(const std::string& name, const Values& values, std::span<const std::uint64_t> shape,
                    Packing packing);
};

}  // namespace fsi::io
