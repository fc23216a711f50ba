#include <camber/base/error.hpp>
#include <camber/io/detail/hdf5_mutex.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/hopr/hopr_file.hpp>

#include <hdf5.h>
#include <mutex>
#include <span>

#include <fmt/format.h>

namespace camber::io {
namespace hopr {
namespace {

/// An HDF5 object and the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] hid_t id() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// HDF5 prints its errors unless told not to; the library never prints.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

hid_t memory_type(const double*) { return H5T_NATIVE_DOUBLE; }
hid_t memory_type(const std::int32_t*) { return H5T_NATIVE_INT32; }
hid_t file_type(const double*) { return H5T_IEEE_F64LE; }
hid_t file_type(const std::int32_t*) { return H5T_STD_I32LE; }

/// Calls visit(name, values, columns) for each array of numbers in the file; 0 columns: a list.
template <class A, class Visit>
void for_each_array(A& arrays, const Visit& visit) {
  visit("ElemInfo", arrays.elem_info, k_elem_columns);
  visit("SideInfo", arrays.side_info, k_side_columns);
  visit("NodeCoords", arrays.node_coords, std::size_t{3});
  visit("GlobalNodeIDs", arrays.node_ids, std::size_t{0});
  visit("BCType", arrays.bc_types, k_type_columns);
  visit("ElemBarycenters", arrays.barycenters, std::size_t{3});
  visit("ElemCounter", arrays.elem_counter, std::size_t{2});
}

class Writer {
 public:
  /// The file is made in memory: HDF5 does not recover from a disk that refuses.
  Writer(const Arrays& arrays, const std::string& path, const std::string& display)
      : arrays_(arrays),
        display_(display),
        access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose),
        file_(create(path), H5Fclose) {
    require(file_.id() >= 0);
  }

  /// The bytes of the file.
  std::string run() {
    attribute("Version", 1.0);
    attribute("Ngeo", static_cast<std::int32_t>(arrays_.order));
    attribute("nElems", static_cast<std::int32_t>(arrays_.elements()));
    attribute("nSides", static_cast<std::int32_t>(arrays_.sides()));
    attribute("nNodes", static_cast<std::int32_t>(arrays_.nodes()));
    attribute("nUniqueSides", arrays_.unique_sides);
    attribute("nUniqueNodes", arrays_.unique_nodes);
    attribute("nBCs", static_cast<std::int32_t>(arrays_.bc_names.size()));
    text_attribute("FEMconnect", "OFF");
    for_each_array(arrays_, [&](const char* name, const auto& values, std::size_t columns) {
      write(name, std::span(values), columns);
    });
    const std::vector<double> weights(arrays_.elements(), 1.0);
    write("ElemWeight", std::span(weights), 0);
    write_names();
    require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
    const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
    require(size > 0);
    std::string image(static_cast<std::size_t>(size), '\0');
    require(H5Fget_file_image(file_.id(), image.data(), image.size()) == size);
    return image;
  }

 private:
  hid_t create(const std::string& path) const {
    constexpr std::size_t k_step = std::size_t{1} << 20;  // bytes that the image grows by
    H5Pset_fapl_core(access_.id(), k_step, false);
    return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_.id());
  }

  void require(bool is_good) const {
    if (is_good) return;
    throw FileError("cannot be made by HDF5", display_, "the mesh may not fit into memory");
  }

  template <class T>
  void attribute(const char* name, T value) {
    const hsize_t one = 1;
    const Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose);
    const Handle made(
        H5Acreate2(file_.id(), name, file_type(&value), space.id(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    require(made.id() >= 0 && H5Awrite(made.id(), memory_type(&value), &value) >= 0);
  }

  /// Characters filled up with blanks, as Fortran has them.
  static hid_t text_type(std::size_t length) {
    const hid_t type = H5Tcopy(H5T_FORTRAN_S1);
    H5Tset_size(type, length);
    return type;
  }

  void text_attribute(const char* name, const std::string& text) {
    const hsize_t one = 1;
    const Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose);
    const Handle type(text_type(text.size()), H5Tclose);
    const Handle made(H5Acreate2(file_.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose);
    require(made.id() >= 0 && H5Awrite(made.id(), type.id(), text.data()) >= 0);
  }

  template <class T>
  void write(const char* name, std::span<const T> values, std::size_t columns) {
    const std::size_t rows = columns == 0 ? values.size() : values.size() / columns;
    write_data(name, file_type(values.data()), memory_type(values.data()), values.data(), rows,
               columns);
  }

  void write_data(const char* name, hid_t in_file, hid_t in_memory, const void* data,
                  std::size_t rows, std::size_t columns) {
    const std::array<hsize_t, 2> size{rows, columns};
    const Handle space(H5Screate_simple(columns == 0 ? 1 : 2, size.data(), nullptr), H5Sclose);
    const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(how.id(), false);  // the same mesh shall give the same bytes
    const Handle set(
        H5Dcreate2(file_.id(), name, in_file, space.id(), H5P_DEFAULT, how.id(), H5P_DEFAULT),
        H5Dclose);
    require(set.id() >= 0);
    if (rows == 0) return;
    require(H5Dwrite(set.id(), in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
  }

  void write_names() {
    std::string all;
    for (const std::string& name : arrays_.bc_names) {
      std::string padded = name.substr(0, k_name_length);
      padded.resize(k_name_length, ' ');
      all += padded;
    }
    const Handle type(text_type(k_name_length), H5Tclose);
    write_data("BCNames", type.id(), type.id(), all.data(), arrays_.bc_names.size(), 0);
  }

  const Arrays& arrays_;
  const std::string& display_;
  Handle access_, file_;
};

template <class T>
bool is_same(hid_t file, const char* name, const std::vector<T>& values) {
  const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  if (set.id() < 0) return false;
  const Handle space(H5Dget_space(set.id()), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.id()) != static_cast<hssize_t>(values.size()))
    return false;
  if (values.empty()) return true;
  std::vector<T> found(values.size());
  return H5Dread(set.id(), memory_type(values.data()), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                 found.data()) >= 0 &&
         found == values;
}

}  // namespace
}  // namespace hopr

NameRules hopr_name_rules() { return {.longest = hopr::k_name_length}; }

void write_hopr(const hopr::Arrays& arrays, const std::string& path, const std::string& display) {
  const std::string image = [&] {
    const std::lock_guard lock(hdf5_mutex());
    const hopr::Quiet quiet;
    return hopr::Writer(arrays, path, display).run();
  }();
  OutputFile out(path, display);
  out.append(image);
  out.finish();
}

void check_hopr(const hopr::Arrays& arrays, const std::string& path, const std::string& display) {
  const std::lock_guard lock(hdf5_mutex());
  const hopr::Quiet quiet;
  const hopr::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  bool all_same = file.id() >= 0;
  hopr::for_each_array(arrays, [&](const char* name, const auto& values, std::size_t) {
    all_same = all_same && hopr::is_same(file.id(), name, values);
  });
  if (all_same) return;
  throw FileError("what was written differs from what is on the disk", display, "check the disk");
}

}  // namespace camber::io
