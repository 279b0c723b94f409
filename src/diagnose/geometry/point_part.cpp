// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/point_part.hpp"

namespace trueaxis::diagnose_detail {

PointPart PointPart::part(std::size_t from, std::size_t to) const {
  PointPart out;
  out.begin = begin + from;
  for (const PointColumn column :
       {&PointPart::c, &PointPart::z, &PointPart::time, &PointPart::speed, &PointPart::velocity,
        &PointPart::x, &PointPart::sensed, &PointPart::dx_dc, &PointPart::dx_dz,
        &PointPart::d2x_dc2, &PointPart::theta, &PointPart::chuck, &PointPart::s, &PointPart::clamp,
        &PointPart::dx_dnormal, &PointPart::dx_dy, &PointPart::sine, &PointPart::cosine})
    out.*column = (this->*column).subspan(from, to - from);
  out.axis = axis.subspan(from, to - from);
  out.rear = rear.subspan(from, to - from);
  return out;
}

void PointRoom::resize(std::size_t size) {
  for (auto* column : {&speed, &velocity, &x, &sensed, &dx_dc, &dx_dz, &d2x_dc2, &theta, &chuck, &s,
                       &clamp, &dx_dnormal, &dx_dy, &sine, &cosine, &z, &from})
    column->resize(size);
  axis.resize(size), rear.resize(size);
}

}  // namespace trueaxis::diagnose_detail
