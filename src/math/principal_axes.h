#pragma once

namespace boxwood {

/// Sums over weighted points and over their products, from which the principal axes follow: one pass, no matrix of
/// points. Give points relative to one of them, or to anything near: then nothing cancels, however far from the origin
/// they lie.
struct Moments {
  double weight = 0;
  double sum[3] = {};
  double square[3] = {};   ///< xx, yy, zz
  double product[3] = {};  ///< xy, yz, zx

  void add(double x, double y, double z, double weight_of_point = 1);
  void add(const Moments& other);
};

/// Orthonormal axes by ascending spread of the points: axis 2 is the first principal component. Signs mean nothing.
/// `spread[i]` is the variance along axis i, the mean of squared distances.
struct PrincipalAxes {
  double axis[3][3];
  double spread[3];
};

/// Eigenvectors of the covariance. The weight must be positive. Jolliffe 2002, "Principal Component Analysis".
PrincipalAxes principal_axes(const Moments& moments);

}  // namespace boxwood
