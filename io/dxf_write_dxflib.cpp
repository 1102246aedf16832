#include <dxflib/dl_dxf.h>

#include <memory>
#include <system_error>

#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/bytes.h"
#include "io/dxf.h"

namespace adit::io {
namespace {

void write_tables(DL_Dxf& library, DL_WriterA& writer, const std::string& layer) {
  const DL_Attributes black("", 7, -1, "CONTINUOUS", 1.0);
  writer.sectionTables();
  library.writeVPort(writer);
  writer.tableLinetypes(3);
  for (const char* name : {"BYBLOCK", "BYLAYER", "CONTINUOUS"})
    library.writeLinetype(writer, DL_LinetypeData(name, name, 0, 0, 0.0));
  writer.tableEnd();
  writer.tableLayers(layer == "0" ? 1 : 2);
  library.writeLayer(writer, DL_LayerData("0", 0), black);
  if (layer != "0") library.writeLayer(writer, DL_LayerData(layer, 0), black);
  writer.tableEnd();
  writer.tableStyle(1);
  library.writeStyle(writer, DL_StyleData("Standard", 0, 2.5, 1.0, 0.0, 0, 2.5, "txt", ""));
  writer.tableEnd();
  library.writeView(writer);
  library.writeUcs(writer);
  writer.tableAppid(1);
  library.writeAppid(writer, "ACAD");
  writer.tableEnd();
  library.writeDimStyle(writer, 2.5, 1.25, 0.625, 0.625, 2.5);
  library.writeBlockRecord(writer);
  writer.tableEnd();
  writer.sectionEnd();
}

void write_blocks(DL_Dxf& library, DL_WriterA& writer) {
  writer.sectionBlocks();
  for (const char* name : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
    library.writeBlock(writer, DL_BlockData(name, 0, 0.0, 0.0, 0.0));
    library.writeEndBlock(writer, name);
  }
  writer.sectionEnd();
}

void write_entities(DL_Dxf& library, DL_WriterA& writer, const Profile& profile, const std::string& layer) {
  const DL_Attributes by_layer(layer, 256, -1, "BYLAYER", 1.0);
  constexpr int closed = 1;
  writer.sectionEntities();
  library.writePolyline(writer, DL_PolylineData(static_cast<int>(profile.segments().size()), 0, 0, closed), by_layer);
  for (const ProfileSegment& segment : profile.segments()) {
    library.writeVertex(writer, DL_VertexData(segment.start.x(), segment.start.y(), 0.0, segment.bulge));
  }
  library.writePolylineEnd(writer);
  writer.sectionEnd();
}

void write_drawing(const std::filesystem::path& file, const Profile& profile, const std::string& layer) {
  DL_Dxf library;
  const std::unique_ptr<DL_WriterA> writer(library.out(file.string().c_str(), DL_VERSION_2000));
  if (!writer) throw Error("the drawing cannot be written", file.string(), "check the folder and its rights");
  library.writeHeader(*writer);
  constexpr int metres = 6;
  writer->dxfString(9, "$INSUNITS");
  writer->dxfInt(70, metres);
  writer->sectionEnd();
  write_tables(library, *writer, layer);
  write_blocks(library, *writer);
  write_entities(library, *writer, profile, layer);
  library.writeObjects(*writer);
  library.writeObjectsEnd(*writer);
  writer->dxfEOF();
  writer->close();
}

}  // namespace

void write_dxf_profile(const std::filesystem::path& file, const Profile& profile, const std::string& layer) {
  // The library writes to a path of its own; what it wrote then appears under its name in one step.
  const std::filesystem::path draft = file.string() + ".draft";
  std::string text;
  try {
    write_drawing(draft, profile, layer);
    const InputFile written(draft);
    text = written.beginning(static_cast<std::size_t>(written.size()));
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(draft, ignored);
    throw;
  }
  std::filesystem::remove(draft);
  write_file_atomically(file, text);
}

}  // namespace adit::io
