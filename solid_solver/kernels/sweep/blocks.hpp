#pragma once
/// Rows are passed over in blocks of as many numbers as a line of the cache holds, from where its lines begin. So no vector
/// lies across two lines, no point is left over to be done by itself, and how a point is rounded does not
/// depend on where its run begins. Blocks reach beyond their run: what is found there goes to work rows that nobody reads, and
/// states are kept. Rows have room for a block before the first and after the last point.

namespace fsi::solid {

inline constexpr int block = 8;

/// Where the block begins in which point i lies.
constexpr int block_with(int i) {
  return i & ~(block - 1);
}

}  // namespace fsi::solid
