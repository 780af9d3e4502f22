#pragma once
/// SolidComponent where several ranks share the body.

#include <utility>
#include <vector>

#include "solid_solver/solid_component.hpp"

namespace fsi::solid {

template <Law L>
void SolidComponent<L>::take_rows(RankRows rows) {
  rows_ = std::move(rows);
  boundary_.take_rows(rows_);
}

template <Law L>
std::vector<FieldView> SolidComponent<L>::scattered_fields() {
  std::vector<FieldView> fields{q_.view(), next_.view()};
  if (chosen_) fields.push_back(source_.view());
  return fields;
}

}  // namespace fsi::solid
