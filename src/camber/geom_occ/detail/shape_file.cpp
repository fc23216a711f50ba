#include <camber/geom_occ/detail/kernel_errors.hpp>
#include <camber/geom_occ/detail/shape_file.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <regex>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

namespace camber::occ {
namespace {

enum class Format { step, iges, brep };

const char* const k_export_again = "export the model again from its CAD system";

Format format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".step" || extension == ".stp") return Format::step;
  if (extension == ".iges" || extension == ".igs") return Format::iges;
  if (extension == ".brep") return Format::brep;
  throw FileError("unknown CAD format '" + extension + "'", path,
                  "give a .step, .stp, .iges, .igs or .brep file");
}

/// Last `count` characters of a readable, non-empty file.
std::string tail_of(const std::string& path, std::streamoff count) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw FileError("no such CAD file", path, "check the path");
  if (!std::filesystem::is_regular_file(path, error))
    throw FileError("the CAD path is not a file", path, "check the path");
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw FileError("the CAD file cannot be opened", path, "check its permissions");
  const std::streamoff size = file.tellg();
  if (size <= 0) throw FileError("the CAD file is empty", path, k_export_again);
  file.seekg(std::max<std::streamoff>(0, size - count));
  std::string text(static_cast<std::size_t>(std::min(size, count)), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

/// Takes the kernel's printers away while it lives: a library never prints.
class SilentKernel {
 public:
  SilentKernel() : printers_(Message::DefaultMessenger()->Printers()) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~SilentKernel() { Message::DefaultMessenger()->ChangePrinters() = printers_; }
  SilentKernel(const SilentKernel&) = delete;
  SilentKernel& operator=(const SilentKernel&) = delete;

 private:
  Message_SequenceOfPrinters printers_;
};

std::string text_of(const Handle(TCollection_HAsciiString) & text) {
  return text.IsNull() ? std::string() : std::string(text->ToCString());
}

std::string name_of(const Handle(Standard_Transient) & item) {
  if (const auto step = Handle(StepRepr_RepresentationItem)::DownCast(item))
    return text_of(step->Name());
  if (const auto iges = Handle(IGESData_IGESEntity)::DownCast(item))
    return iges->HasName() ? text_of(iges->NameValue()) : std::string();
  return {};
}

/// Names of the file's entities that became faces, edges or vertices.
void collect_names(const XSControl_Reader& reader, ShapeFile& result) {
  const Handle(Transfer_TransientProcess) process =
      reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const std::string name = name_of(process->Mapped(i));
    if (name.empty() || name == "NONE") continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, process->Mapped(i));
    if (!shape.IsNull() && shape.ShapeType() >= TopAbs_FACE && shape.ShapeType() != TopAbs_WIRE)
      result.names.emplace(shape.TShape().get(), name);
  }
}

ShapeFile read_exchange(XSControl_Reader& reader, const std::string& path) {
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    throw FileError("OpenCASCADE cannot read the CAD file", path, k_export_again);
  reader.TransferRoots();
  ShapeFile result;
  result.shape = reader.OneShape();
  if (!result.shape.IsNull()) collect_names(reader, result);
  return result;
}

ShapeFile read_step(const std::string& path) {
  if (tail_of(path, 4096).find("END-ISO-10303-21") == std::string::npos)
    throw FileError("the STEP file does not end with END-ISO-10303-21: truncated or not STEP", path,
                    k_export_again);
  STEPControl_Reader reader;
  return read_exchange(reader, path);
}

ShapeFile read_iges(const std::string& path) {
  // The last record of an IGES file is its terminate section: T in column 73.
  std::string tail = tail_of(path, 512);
  while (!tail.empty() && std::isspace(static_cast<unsigned char>(tail.back()))) tail.pop_back();
  const std::size_t line = tail.find_last_of("\r\n");
  const std::string last = line == std::string::npos ? tail : tail.substr(line + 1);
  if (last.size() < 73 || last[72] != 'T')
    throw FileError("the IGES file has no terminate section: truncated or not IGES", path,
                    k_export_again);
  IGESControl_Reader reader;
  return read_exchange(reader, path);
}

ShapeFile read_brep(const std::string& path) {
  // Checked here, as the kernel's reader prints on what it cannot read.
  const std::string tail = tail_of(path, 256);
  std::ifstream file(path, std::ios::binary);
  std::string head(1024, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head.find("CASCADE Topology V") == std::string::npos)
    throw FileError("the file does not start as an OpenCASCADE BREP (text) file", path,
                    k_export_again);
  // The last record names the whole shape: sign, number, location.
  static const std::regex k_whole_shape("[\r\n][+-][0-9]+ [0-9]+[ \t]*[\r\n]");
  if (!std::regex_search(tail + "\n", k_whole_shape))
    throw FileError("the BREP file does not end with its shape: truncated", path, k_export_again);
  ShapeFile result;
  BRep_Builder builder;
  if (!BRepTools::Read(result.shape, path.c_str(), builder))
    throw FileError("OpenCASCADE cannot read the BREP file", path, k_export_again);
  return result;
}

}  // namespace

ShapeFile read_shape_file(const std::string& path) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const SilentKernel silence;
  try {
    switch (format_of(path)) {
      case Format::step:
        return read_step(path);
      case Format::iges:
        return read_iges(path);
      case Format::brep:
        return read_brep(path);
    }
  } catch (const Standard_Failure& failure) {
    throw FileError("OpenCASCADE failed to read the CAD file: " + message_of(failure), path,
                    k_export_again);
  }
  return {};
}

}  // namespace camber::occ
