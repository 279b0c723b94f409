// SPDX-License-Identifier: Apache-2.0
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "interchange/formats.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// A handle of the library, closed at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool good() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The text of an attribute, of fixed or variable length; "" where there is none.
std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose);
  if (!attribute.good()) return {};
  const Handle type(H5Aget_type(attribute), &H5Tclose);
  const Handle space(H5Aget_space(attribute), &H5Sclose);
  if (!type.good() || !space.good() || H5Tget_class(type) != H5T_STRING ||
      H5Sget_simple_extent_npoints(space) != 1)
    return {};
  std::string text;
  if (H5Tis_variable_str(type) > 0) {
    const Handle memory(H5Tcopy(H5T_C_S1), &H5Tclose);
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5Tget_cset(type));
    char* read = nullptr;
    if (H5Aread(attribute, memory, &read) >= 0 && read != nullptr) text = read;
    if (read != nullptr) H5free_memory(read);
  } else {
    text.resize(std::min<std::size_t>(H5Tget_size(type), 256));
    if (H5Tget_size(type) > 256 || H5Aread(attribute, type, text.data()) < 0) return {};
    text.resize(std::min(text.find('\0'), text.size()));
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// The one number of an attribute: nothing where there is none, NaN where it is something else.
std::optional<double> number_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const double no_number = std::nan("");
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose);
  if (!attribute.good()) return no_number;
  const Handle type(H5Aget_type(attribute), &H5Tclose);
  const Handle space(H5Aget_space(attribute), &H5Sclose);
  if (!type.good() || !space.good() || H5Sget_simple_extent_npoints(space) != 1 ||
      (H5Tget_class(type) != H5T_INTEGER && H5Tget_class(type) != H5T_FLOAT))
    return no_number;
  double value = 0.0;
  return H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) >= 0 ? value : no_number;
}

/// Why the numbers are not in this file, or "".
std::string elsewhere(hid_t set) {
  const Handle made(H5Dget_create_plist(set), &H5Pclose);
  if (H5Pget_external_count(made) > 0) return "stored in another file";
  return H5Pget_layout(made) == H5D_VIRTUAL ? "a view of other files" : "";
}

class Hdf5 {
 public:
  explicit Hdf5(const std::string& path) : path_(path), budget_(path) {
    file_.kind = "an HDF5 file";
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // this project reports what is wrong
  }

  NumberFile read(const std::string& bytes) {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
    H5Pset_fapl_core(access, std::size_t{1} << 16U, false);
    // The library takes a copy and does not write to what it is given.
    H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size());
    // An image in memory must not have the name of a file: nothing is below one.
    const std::string nowhere = path_ + "/in memory";
    const Handle file(H5Fopen(nowhere.c_str(), H5F_ACC_RDONLY, access), &H5Fclose);
    if (!file.good()) throw InputError(path_, "is not a complete HDF5 file: copy it again");
    const auto each = [](hid_t, const char* name, const H5O_info_t* info, void* self) -> herr_t {
      if (info->type == H5O_TYPE_DATASET) static_cast<Hdf5*>(self)->names_.emplace_back(name);
      return 0;
    };
    if (H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, each, this) < 0)
      throw InputError(path_, "is an HDF5 file whose contents cannot be listed: copy it again");
    for (const std::string& name : names_) file_.arrays.push_back(data_set(file, name));
    return std::move(file_);
  }

 private:
  NumberArray data_set(hid_t file, const std::string& name) {
    NumberArray array;
    array.name = name;
    const auto fail = [&](const std::string& why) {
      throw InputError(path_, "its data set " + name + " " + why);
    };
    const Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!set.good()) fail("cannot be opened: copy the file again");
    const Handle type(H5Dget_type(set), &H5Tclose);
    const Handle space(H5Dget_space(set), &H5Sclose);
    const H5T_class_t kind = H5Tget_class(type);
    const int dimensions = H5Sget_simple_extent_ndims(space);
    if (kind == H5T_COMPOUND)
      array.unusable = "complex numbers or records";
    else if (kind != H5T_INTEGER && kind != H5T_FLOAT)
      array.unusable = kind == H5T_STRING ? "text" : "no numbers";
    else if (text_attribute(set, "MATLAB_class") == "char")
      array.unusable = "text";
    else if (dimensions > 2 || dimensions < 0)
      array.unusable = std::to_string(dimensions) + " dimensions";
    else
      array.unusable = elsewhere(set);
    if (!array.unusable.empty()) return array;
    hsize_t extent[2] = {1, 1};
    if (dimensions > 0) H5Sget_simple_extent_dims(space, extent, nullptr);
    array.rows = extent[0];
    array.columns = extent[1];
    array.unit = text_attribute(set, "units");
    if (array.unit.empty()) array.unit = text_attribute(set, "unit");
    array.values.resize(budget_.take(name, array.rows, array.columns));
    if (!array.values.empty() &&
        H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0)
      fail("cannot be read: it is incomplete, its check sum is wrong, or a filter is missing");
    unpack(set, array);
    return array;
  }

  /// The numbers as netCDF packs them (CF 8.1, 2.5.1): what is missing becomes NaN, the others
  /// packed × scale_factor + add_offset.
  void unpack(hid_t set, NumberArray& array) {
    for (const char* name : {"_FillValue", "missing_value"})
      if (const auto missing = number_attribute(set, name))
        std::ranges::replace(array.values, *missing, std::nan(""));
    const auto scale = number_attribute(set, "scale_factor");
    const auto offset = number_attribute(set, "add_offset");
    if (!scale && !offset) return;
    if ((scale && !std::isfinite(*scale)) || (offset && !std::isfinite(*offset)))
      throw InputError(path_, "its data set " + array.name +
                                  " has a scale_factor or add_offset that is not one number: "
                                  "correct the attribute");
    file_.notes.push_back(array.name + " is unpacked by its scale_factor and add_offset");
    for (double& value : array.values) value = value * scale.value_or(1.0) + offset.value_or(0.0);
  }

  const std::string& path_;
  NumberBudget budget_;
  NumberFile file_;
  std::vector<std::string> names_;
};

}  // namespace

NumberFile read_hdf5(const std::string& path, const std::string& bytes) {
  return Hdf5(path).read(bytes);
}

}  // namespace trueaxis
