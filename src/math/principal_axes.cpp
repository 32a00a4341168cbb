#include "math/principal_axes.h"

#include <Eigen/Eigenvalues>

namespace boxwood {

void Moments::add(double x, double y, double z, double w) {
  weight += w;
  sum[0] += w * x;
  sum[1] += w * y;
  sum[2] += w * z;
  square[0] += w * x * x;
  square[1] += w * y * y;
  square[2] += w * z * z;
  product[0] += w * x * y;
  product[1] += w * y * z;
  product[2] += w * z * x;
}

void Moments::add(const Moments& other) {
  weight += other.weight;
  for (int i = 0; i < 3; ++i) {
    sum[i] += other.sum[i];
    square[i] += other.square[i];
    product[i] += other.product[i];
  }
}

PrincipalAxes principal_axes(const Moments& moments) {
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double mean = moments.sum[i] / moments.weight;
    covariance(i, i) = moments.square[i] / moments.weight - mean * mean;
    covariance(i, j) = covariance(j, i) = moments.product[i] / moments.weight - mean * moments.sum[j] / moments.weight;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  PrincipalAxes axes;
  for (int i = 0; i < 3; ++i) {
    axes.spread[i] = solver.eigenvalues()[i];
    for (int j = 0; j < 3; ++j) axes.axis[i][j] = solver.eigenvectors()(j, i);
  }
  return axes;
}

}  // namespace boxwood
