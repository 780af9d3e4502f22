#include "common/case/document/reader.hpp"

#include <fmt/format.h>

namespace fsi {

using config::Node;

GasExpressions Reader::gas_state(const Node& node, const std::string& path) const {
  const Node* p = node.find("p");
  const Node* T = node.find("T");
  if ((p == nullptr) == (T == nullptr)) config::fail(node.place, path, "give p or T, one of them");
  const Node& rho = *node.find("rho");
  const VectorExpressions v = vector(*node.find("v"));
  const auto pressure_from_T = [&] {
    return Expression(fmt::format("({})*({})", rho.text, T->text), scope_.constants, scope_.definitions);
  };
  return {expression(rho), v.c1, v.c2, p != nullptr ? expression(*p) : pressure_from_T()};
}

bool Reader::from_reference(const Node& node, const std::string& path, std::string_view otherwise) const {
  if (!node.is_scalar()) return false;
  const Node* reference = root_.find("reference");
  const Node* kind = reference == nullptr ? nullptr : reference->find("kind");
  if (kind == nullptr || kind->text == "none") {
    config::fail(node.place, path,
                 fmt::format("takes its data from `reference`, but the case has no reference solution; {}",
                             otherwise));
  }
  return true;
}

}  // namespace fsi
