#include "common/ranks/ranks.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "common/ranks/module.hpp"

namespace fsi {

namespace {

class OneRank final : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void exchange(std::span<const Parcel>, std::span<const Parcel>) override {}
  void broadcast(std::vector<double>&) override {}
  std::vector<double> together(std::span<const double> mine) override { return {mine.begin(), mine.end()}; }
  void largest_of_each(std::span<double>) override {}
  void leave() override {}
};

/// Beside the program.
std::filesystem::path path_of_module() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / ranks_module;
}

}  // namespace

std::shared_ptr<Ranks> one_rank() {
  return std::make_shared<OneRank>();
}

std::shared_ptr<Ranks> open_ranks(int size) {
  if (size == 1) return one_rank();
  // Never closed: Open MPI has threads of its own, and what it leaves to the end of the program.
  void* module = dlopen(path_of_module().c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr)
    throw UserMistake(
        fmt::format("{} ranks need Open MPI, which this build has not ({}); install libopenmpi-dev and "
                    "openmpi-bin, and build again",
                    size, dlerror()));  // NOLINT(concurrency-mt-unsafe): the only thread
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): that is what dlsym gives
  const auto open = reinterpret_cast<OpenRanks*>(dlsym(module, open_ranks_symbol));
  if (open == nullptr)
    throw UserMistake(fmt::format("{} is not of this build; build again", path_of_module().string()));
  std::shared_ptr<Ranks> ranks(open());
  if (ranks->size() != size)
    throw UserMistake(
        fmt::format("--ranks {}, but {} were started together; start {} with mpirun, as "
                    "./launch/fsi run --ranks does",
                    size, ranks->size(), size));
  return ranks;
}

std::vector<double> as_values(const std::string& text) {
  return {text.begin(), text.end()};
}

std::string as_text(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += static_cast<char>(value);
  return text;
}

}  // namespace fsi
