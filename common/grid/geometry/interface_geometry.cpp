#include "common/grid/geometry/interface_geometry.hpp"

#include <cmath>
#include <cstddef>

namespace fsi::grid {

std::vector<double> tangents(std::span<const double> x, Curve curve) {
  const std::size_t n = x.size() / 2;
  std::vector<double> t(2 * n);
  for (std::size_t c = 0; c < 2; ++c) {
    const std::span<const double> f = x.subspan(c * n, n);
    double* d = t.data() + c * n;
    for (std::size_t k = 1; k + 1 < n; ++k) d[k] = 0.5 * (f[k + 1] - f[k - 1]);
    if (curve == Curve::closed) {
      d[0] = d[n - 1] = 0.5 * (f[1] - (f[n - 2] - (f[n - 1] - f[0])));
    } else {
      d[0] = -1.5 * f[0] + 2 * f[1] - 0.5 * f[2];
      d[n - 1] = 1.5 * f[n - 1] - 2 * f[n - 2] + 0.5 * f[n - 3];
    }
  }
  return t;
}

std::vector<double> normals(std::span<const double> x, Curve curve, double orientation) {
  std::vector<double> n_vectors = tangents(x, curve);
  const std::size_t n = x.size() / 2;
  for (std::size_t k = 0; k < n; ++k) {
    const double t1 = n_vectors[k], t2 = n_vectors[n + k];
    const double scale = orientation / std::hypot(t1, t2);
    n_vectors[k] = scale * t2;
    n_vectors[n + k] = -scale * t1;
  }
  return n_vectors;
}

}  // namespace fsi::grid
