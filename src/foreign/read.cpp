#include "foreign/read.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/os.h"
#include "base/process.h"
#include "base/text.h"
#include "foreign/scene.h"
#include "formats/format_table.h"
#include "formats/read.h"
#include "formats/surface_builder.h"

namespace viete::foreign {

namespace fs = std::filesystem;

namespace {

constexpr const char* convert = "convert it to glTF or OBJ in another program";

// The morph targets of a foreign file. There is no animation.
class SceneMorphs final : public formats::MorphClip {
public:
  SceneMorphs(std::vector<mesh::Point> rest, std::vector<Target> targets) : rest_(std::move(rest)) {
    for (Target& target : targets) {
      targets_.push_back(std::move(target.name));
      positions_.push_back(std::move(target.positions));
    }
  }

  std::vector<mesh::Point> at(double) const override { return rest_; }
  std::vector<mesh::Point> at_target(std::size_t target) const override { return positions_[target]; }

private:
  std::vector<mesh::Point> rest_;
  std::vector<std::vector<mesh::Point>> positions_;
};

// A foreign file cannot be written again; its images are inputs, and some content is not read.
class ForeignOriginal final : public formats::Original {
public:
  ForeignOriginal(const Kind& kind, const formats::Source& source, Scene scene)
      : Original(kind.name, source), ignored_(std::move(scene.ignored)) {
    companions_.folder = source.folder;
    for (const formats::ImageFile& image : scene.attributes.images)
      if (!image.path.empty()) companions_.files.push_back(image.path);
    if (!scene.targets.empty())
      morphs_ = std::make_shared<const SceneMorphs>(std::move(scene.positions), std::move(scene.targets));
  }

  std::vector<std::string> beyond_attributes() const override { return ignored_; }
  std::shared_ptr<const formats::MorphClip> morphs() const override { return morphs_; }

private:
  std::vector<std::string> ignored_;
  std::shared_ptr<const formats::MorphClip> morphs_;
};

std::string importer() {
  if (std::string named = base::os::variable("VIETE_IMPORT"); !named.empty()) return named;
  const std::string name = base::os::program_name("viete-import");
  const fs::path beside = base::os::program_file().parent_path() / name;
  std::error_code ignored;
  return fs::exists(beside, ignored) ? beside.string() : name;
}

// The texts of errors about a file that viete-import reads.
struct Task {
  std::string files;    // "FBX files are"
  std::string failure;  // "Assimp could not read this FBX file: "
  std::string package, advice;
};

Task task_of(const Kind& kind) {
  const std::string name(kind.name);
  return {name + " files are", "Assimp could not read this " + name + " file: ", "Assimp (libassimp-dev)",
          convert};
}

Task task_of(const formats::CompressedGltf& file) {
  const bool draco = file.extension.starts_with("KHR_draco");
  return {"the meshes are compressed (" + file.extension + "), and are",
          "the compressed meshes cannot be read: ",
          draco ? "Draco (libdraco-dev)" : "meshoptimizer (libmeshoptimizer-dev)", file.advice()};
}

base::Error unreadable(const formats::Source& source, const Task& task, const std::string& reason) {
  return {source.name, task.failure + reason, task.advice};
}

// Runs viete-import with these arguments. Returns its output.
std::string output_of_importer(const formats::Source& source, const Task& task,
                               std::vector<std::string> arguments, double most_seconds) {
  std::optional<base::ChildProgram> child;
  try {
    constexpr bool keeps_output = true;
    arguments.insert(arguments.begin(), importer());
    arguments.push_back(fs::absolute(source.name).string());
    child.emplace(arguments, "", std::vector<std::string>{}, keeps_output);
  } catch (const base::Error& error) {
    throw base::Error(source.name, task.files + " read by viete-import: " + error.problem(),
                      "install " + task.package + " and build Viete again, or " + task.advice);
  }
  base::Progress own;
  const base::ProgressPart part(source.progress, 0, 0.8);
  child->follow(source.progress ? *source.progress : own, most_seconds);
  if (child->running())
    throw unreadable(source, task, base::formatted("it took longer than %g seconds", most_seconds));
  try {
    child->finish();
  } catch (const base::Error&) {
    throw unreadable(source, task, "it crashed, or used too much memory or time");
  }
  return child->output();
}

Scene scene_of_output(const formats::Source& source, const Task& task, std::string_view output) {
  try {
    Scene scene = scene_of(output);
    for (const formats::ImageFile& image : scene.attributes.images)
      if (!image.path.empty() && !base::is_file_below(base::folder_of(source.name), image.path))
        throw DamagedScene("an image is not in the folder of the file");
    return scene;
  } catch (const DamagedScene& damage) {
    throw base::Error(source.name, "viete-import sent no valid scene: " + std::string(damage.what()),
                      "install viete and viete-import of the same version, or " + task.advice);
  }
}

formats::ReadResult read_foreign(const formats::Source& source, const Kind& kind, double most_seconds) {
  const Task task = task_of(kind);
  Scene scene = scene_of_output(source, task, output_of_importer(source, task, {}, most_seconds));
  if (!scene.failure.empty()) throw unreadable(source, task, base::printable(scene.failure, 600));
  formats::SurfaceBuilder builder(source);
  mesh::Surface& surface = builder.surface();
  surface.positions = scene.positions;
  surface.corners = std::move(scene.corners);
  surface.polygon_starts = std::move(scene.polygon_starts);
  for (const std::string& note : scene.notes) builder.warn(note);
  formats::ReadResult result = builder.finish(std::string(kind.name), scene.attributes);
  result.original = std::make_shared<const ForeignOriginal>(kind, source, std::move(scene));
  return result;
}

// viete-import sends a GLB without compression, or a scene with the reason of its failure and advice.
formats::ReadResult read_compressed(formats::Source source, const formats::CompressedGltf& file,
                                    double most_seconds) {
  const Task task = task_of(file);
  const auto output =
      std::make_shared<const std::string>(output_of_importer(source, task, {"--decompress"}, most_seconds));
  if (!output->starts_with("glTF")) {
    const Scene scene = scene_of_output(source, task, *output);
    throw base::Error(source.name, task.failure + base::printable(scene.failure, 600));
  }
  source.bytes = *output;
  source.owner = output;
  const base::ProgressPart part(source.progress, 0.8, 1);
  formats::ReadResult result = formats::read(source);
  result.format = "glTF compressed";
  result.warnings.push_back(source.name + ": decompressed (" + file.extension +
                            "); saving writes it uncompressed");
  return result;
}

}  // namespace

std::span<const Kind> all_kinds() {
  static constexpr Kind kinds[] = {
      {"fbx", "FBX"},       {"dae", "Collada"},   {"zae", "Collada"},   {"3ds", "3DS"},
      {"blend", "Blender"}, {"x", "DirectX"},     {"lwo", "LightWave"}, {"lws", "LightWave"},
      {"lxo", "Modo"},      {"3mf", "3MF"},       {"amf", "AMF"},       {"x3d", "X3D"},
      {"x3db", "X3D"},      {"wrl", "VRML"},      {"m3d", "M3D"},       {"ms3d", "MilkShape"},
      {"ogex", "OpenGEX"},  {"iqm", "IQM"},       {"ase", "ASE"},       {"ac", "AC3D"},
      {"b3d", "Blitz3D"},   {"cob", "trueSpace"}, {"scn", "trueSpace"}, {"dxf", "DXF"},
      {"hmp", "HMP"},       {"ifc", "IFC"},       {"irr", "Irrlicht"},  {"irrmesh", "Irrlicht"},
      {"md2", "MD2"},       {"md3", "MD3"},       {"md5mesh", "MD5"},   {"mdc", "MDC"},
      {"mdl", "MDL"},       {"ndo", "Nendo"},     {"nff", "NFF"},       {"pmx", "PMX"},
      {"q3o", "Quick3D"},   {"q3s", "Quick3D"},   {"sib", "Silo"},      {"smd", "SMD"},
      {"ter", "Terragen"},  {"xgl", "XGL"},       {"zgl", "XGL"}};
  return kinds;
}

std::string model_formats() {
  return formats::format_names(formats::holds_surface, ", ") + ", FBX and others";
}

std::string a_mesh() {
  return "Mesh (" + model_formats() + ")";
}

const Kind* kind_of(const fs::path& file) {
  const auto found = std::ranges::find(all_kinds(), base::extension_of(file), &Kind::extension);
  return found == all_kinds().end() ? nullptr : &*found;
}

formats::ReadResult read(const fs::path& path, base::Progress* progress, bool played, double most_seconds) {
  formats::Source source{path.string(), base::extension_of(path), "", progress};
  source.folder = fs::absolute(path).parent_path();
  source.played = played;
  if (const Kind* const kind = kind_of(path)) {
    (void)base::regular_file_size(path);  // throws the usual errors
    return read_foreign(source, *kind, most_seconds);
  }
  try {
    return formats::read(path, progress, played);
  } catch (const formats::CompressedGltf& file) {
    return read_compressed(source, file, most_seconds);
  }
}

}  // namespace viete::foreign
