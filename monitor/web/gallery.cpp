#include "monitor/web/gallery.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace fsi::monitor {

namespace {

/// A browser that has not asked for this time looks elsewhere.
constexpr std::chrono::seconds patience_with_browsers{3};
constexpr std::size_t most_wishes = 16, longest_wish = 32;
/// More than the programs of a run have quantities: anybody may send pictures under any name.
constexpr std::size_t most_frames = 256;
constexpr std::size_t most_kept_bytes = std::size_t{256} << 20U;
constexpr std::size_t most_at_once = std::size_t{4} << 20U;  ///< of one answer [byte]
constexpr std::uint64_t newest = std::numeric_limits<std::uint64_t>::max();

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  const std::size_t place = bytes.size(), length = values.size() * sizeof(T);
  bytes.resize(place + length);
  if (length > 0) std::memcpy(bytes.data() + place, values.data(), length);
}

void fill_up(std::string& bytes, char filler) {
  while (bytes.size() % sizeof(float) != 0) bytes += filler;
}

std::string encoded(const wire::Picture& picture) {
  nlohmann::json grids = nlohmann::json::array();
  for (const auto& grid : picture.grids)
    grids.push_back({{"name", grid.name}, {"n1", grid.n1}, {"n2", grid.n2}, {"straight", grid.straight}});
  const nlohmann::json header = {
      {"from", picture.from}, {"role", picture.role}, {"quantity", picture.quantity}, {"step", picture.step},
      {"t", picture.t},       {"low", picture.low},   {"high", picture.high},         {"grids", grids}};
  std::string text = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  fill_up(text, ' ');
  std::string bytes;
  append(bytes, std::vector{static_cast<std::uint32_t>(text.size())});
  bytes += text;
  for (const auto& grid : picture.grids) {
    append(bytes, grid.x);
    append(bytes, grid.level);
    fill_up(bytes, '\0');
  }
  return bytes;
}

}  // namespace

void Gallery::hang(const wire::Picture& picture) {
  put({picture.from, picture.quantity, newest}, picture);
}

void Gallery::keep(const wire::Picture& picture) {
  put({picture.from, picture.quantity, picture.step}, picture);
}

void Gallery::put(const Place& place, const wire::Picture& picture) {
  auto bytes = std::make_shared<const std::string>(encoded(picture));
  {
    const std::scoped_lock lock(mutex_);
    const bool live = std::get<2>(place) == newest;
    if (!frames_.contains(place)) {
      if (live ? live_ >= most_frames : kept_bytes_ + bytes->size() > most_kept_bytes) return;
      live ? ++live_ : kept_bytes_ += bytes->size();
    }
    frames_[place] = {.version = ++version_, .role = picture.role, .bytes = std::move(bytes)};
  }
  changed_.notify_all();
}

Hanging Gallery::wait(std::uint64_t after, const std::vector<std::string>& wishes,
                      std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  for (const std::string& wish : wishes) {
    const bool known = wishes_.contains(wish);
    if (known || (wish.size() <= longest_wish && wishes_.size() < most_wishes)) wishes_[wish] = Clock::now();
  }
  Hanging found;
  changed_.wait_for(lock, patience, [&] {
    found = newer(after, wishes);
    return closed_ || !found.bytes.empty();
  });
  return found;
}

/// The oldest first, and no more than a browser takes at once: it then asks for the others.
Hanging Gallery::newer(std::uint64_t after, const std::vector<std::string>& wishes) const {
  std::vector<const Frame*> found;
  for (const auto& [place, frame] : frames_) {
    const bool wished = std::ranges::find(wishes, frame.role + "." + std::get<1>(place)) != wishes.end();
    if (frame.version > after && (wished || frame.role == "coupler")) found.push_back(&frame);
  }
  std::ranges::sort(found, {}, &Frame::version);
  Hanging answer{.version = version_, .bytes = {}};
  for (const Frame* frame : found) {
    if (!answer.bytes.empty() && answer.bytes.size() + frame->bytes->size() > most_at_once) return answer;
    answer.bytes += *frame->bytes;
    answer.version = frame == found.back() ? version_ : frame->version;
  }
  return answer;
}

std::vector<std::string> Gallery::wishes() {
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  std::erase_if(wishes_, [now](const auto& wish) { return now - wish.second > patience_with_browsers; });
  std::vector<std::string> all;
  for (const auto& [wish, asked_at] : wishes_) all.push_back(wish);
  return all;
}

void Gallery::close() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

}  // namespace fsi::monitor
