// SPDX-License-Identifier: Apache-2.0
// In place of hdf5.cpp and matlab.cpp where their libraries are left out (TRUEAXIS_HDF5=OFF).
#include "interchange/formats.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

NumberFile read_hdf5(const std::string& path, const std::string&) {
  throw InputError(path,
                   "is an HDF5 file, which this build of TrueAxis cannot read: write its "
                   "columns as text (CSV)");
}

NumberFile read_matlab(const std::string& path, const std::string&) {
  throw InputError(path,
                   "is a MATLAB file, which this build of TrueAxis cannot read: write its "
                   "columns as text (CSV)");
}

}  // namespace trueaxis
