#include "formats/read.h"
#include "formats/write.h"
#include "program/command_line.h"
#include "support/cube.h"
#include "support/pictures.h"

using namespace viete;
using namespace viete::test;

namespace {

// The files of a small model, a cage, a pose and a session.
struct SmallFiles : WorkFolder {
  SmallFiles() {
    formats::write(*this / "model.obj", cube(1));
    formats::write(*this / "cage.obj", cube(1.5));
    formats::write(*this / "pose.obj", cube(2));
    put_file(*this / "s.viete",
             R"({"format": "viete session", "version": 1, "model": "model.obj", "cage": "cage.obj"})");
  }
};

}  // namespace

TEST_CASE("inputs_are_not_overwritten_under_any_name") {
  const SmallFiles files;
  fs::create_symlink("model.obj", files / "link.obj");
  fs::create_symlink("model.obj", files / "link.png");
  const std::string deform = "deform model.obj cage.obj --pose pose.obj -o ";
  const char* names[] = {"model.obj", "cage.obj", "pose.obj", "s.viete"};
  std::vector<std::string> before;
  for (const char* name : names) before.push_back(file_bytes(files / name));
  for (const std::string& line :
       {deform + "model.obj", deform + "cage.obj", deform + "./pose.obj", deform + "link.obj",
        deform + quoted(files / "cage.obj"), std::string("deform s.viete -o cage.obj"),
        std::string("render model.obj -o link.png")}) {
    files.refused(line, 1, "is an input file");
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(file_bytes(files / names[i]) == before[i]);
  }
  files.done(deform + "pose.obj --force");
  CHECK(file_bytes(files / "pose.obj") != before[2]);
}

TEST_CASE("dependencies_and_key_files_are_not_overwritten") {
  const SmallFiles files;
  put_file(files / "model.mtl", "newmtl skin\nmap_Kd skin_0003.png\n");
  put_file(files / "m_05.obj", "mtllib model.mtl\nusemtl skin\n" + file_bytes(files / "model.obj"));
  render::write_png(files / "skin_0003.png", {1, 1, {255, 0, 0, 255}});
  render::write_png(files / "other.png", {1, 1, {0, 0, 255, 255}});
  fs::create_symlink("skin_0003.png", files / "link.png");
  for (const auto& [number, from] : {std::pair{"1", "cage.obj"}, {"9", "pose.obj"}})
    fs::copy_file(files / from, files / (std::string("p_") + number + ".obj"));
  const std::string animate = "animate m_05.obj cage.obj --keys ";
  for (const char* keys : {"k.pc2", "k.mdd", "k.glb"})
    files.done("animate cage.obj cage.obj --keys p_#.obj -o " + std::string(keys));
  fs::create_symlink("k.glb", files / "link.glb");
  std::map<std::string, std::string> before;
  for (const auto& entry : fs::directory_iterator(files.path()))
    before[entry.path().filename()] = file_bytes(entry.path());
  for (const std::string& line :
       {std::string("render m_05.obj -o skin_0003.png"), std::string("render m_05.obj -o link.png"),
        std::string("render other.obj m_05.obj -o skin_0003.png"), animate + "k.pc2 -o k.pc2",
        animate + "k.mdd -o ./k.mdd", animate + "k.glb -o link.glb", animate + "p_#.obj -o p_#.obj",
        animate + "p_1.obj -o p_#.obj --frames 5-20", animate + "p_#.obj -o p_#.obj --force",
        animate + "p_#.obj -o m_##.obj", animate + "p_#.obj -o m_##.obj --force",
        animate + "p_#.obj -o skin_####.png --size 64x48"}) {
    fs::copy_file(files / "cage.obj", files / "other.obj", fs::copy_options::overwrite_existing);
    files.refused(line, 1, "is an input file (");
    for (const auto& [name, bytes] : before)
      CHECK_MESSAGE(file_bytes(files / name) == bytes, line << " changed " << name);
  }
  files.done("render m_05.obj --size 64x48 -o other.png");
  files.done(animate + "p_#.obj -o m_##.obj --frames 1-4");
}

TEST_CASE("failed_writes_have_a_message_and_leave_no_part") {
  const WorkFolder files;
  const std::string there = "cd " + quoted(files.path()) + " && ";
  const Outcome limited = run(posed + " -o out.ply", there + "ulimit -f 8 &&");
  CHECK(limited.code == 1);
  CHECK(mentions(limited, "out.ply: cannot be written: File too large; raise the limit of the file size"));
  CHECK(files.entries() == 0);
  const std::string viete = quoted(build_dir() / "viete");
  for (const char* words : {" --help", " --version", " deform --help", " info"}) {
    const Outcome full = outcome_of(viete + words + " 2>&1 > /dev/full");
    CHECK(full.code == 1);
    CHECK(mentions(full, "viete: standard output could not be written"));
  }
  CHECK(outcome_of("(" + viete + " --help 2>&1; echo $? >&2) 2>&1 | head -1").text.starts_with("Viete"));
}

TEST_CASE("outputs_are_checked_before_the_work") {
  const SmallFiles files;
  put_file(files / "locked.obj", "precious");
  fs::permissions(files / "locked.obj", fs::perms::owner_read);
  for (const char* name : {"letter.png", "letter.json"}) put_file(files / name, "precious");
  for (const auto& [line, reason] :
       {std::pair{"deform none.obj cage.obj --pose pose.obj -o none/a.obj", "none/a.obj: cannot be written"},
        {"deform none.obj cage.obj --pose pose.obj -o a.txt", "a.txt: unknown extension .txt"},
        {"deform none.obj cage.obj --pose pose.obj -o locked.obj --force",
         "locked.obj: this file is write-pro"},
        {"render none.obj -o none/a.png", "none/a.png: cannot be written"},
        {"render none.obj -o a.jpg", "a.jpg: pictures can only be written as PNG"},
        {"render none.obj -o letter.png", "and would be replaced; choose another name"},
        {"bench exp --json letter.json", "and would be replaced; choose another name"},
        {"bench exp --json none/a", "none/a: cannot be written"},
        {"bench frame --json none/a", "none/a: cannot be written"},
        {"bench bind --json none/a", "none/a: cannot be written"}})
    files.refused(line, 1, reason);
}

TEST_CASE("a_foreign_file_is_caged_deformed_and_written_in_another_format") {
  const WorkFolder files;
  fs::copy_file(source_dir() / "tests/foreign/smile.fbx", files / "smile.fbx");
  const Outcome info = files.viete("info smile.fbx");
  if (info.code != 0) return (void)CHECK(mentions(info, "viete-import"));  // built without Assimp
  files.done("cage smile.fbx --kind box -o box.obj");
  const Outcome deformed = files.done("deform smile.fbx box.obj --pose box.obj -o out.obj");
  CHECK(!mentions(deformed, "left out"));
  CHECK(file_bytes(files / "out.obj").find("o Box\n") != std::string::npos);
  CHECK(file_bytes(files / "out.obj").find("f 1 2 3 4") != std::string::npos);
  files.done("between smile.fbx smile.fbx -o smile.obj --at 1");  // its morph target is a shape
  CHECK(formats::read(files / "smile.obj").surface.positions[2][1] == doctest::Approx(3.5));
  files.refused("deform smile.fbx box.obj --pose box.obj -o out.fbx", 1, "unknown extension .fbx; use .obj");
  CHECK(mentions(run("info " + quoted(files / "smile.fbx"), "VIETE_IMPORT=/bin/false"), "it crashed"));
}

TEST_CASE("a_compressed_gltf_file_is_caged_deformed_and_written_without_compression") {
  const WorkFolder files;
  fs::copy_file(source_dir() / "tests/foreign/packed.gltf", files / "packed.gltf");
  const Outcome info = files.viete("info packed.gltf");
  if (info.code != 0) return (void)CHECK(mentions(info, "libdraco-dev"));  // built without Draco
  CHECK(mentions(info,
                 "packed.gltf: decompressed (KHR_draco_mesh_compression); saving writes it uncompressed"));
  files.done("cage packed.gltf --kind box -o box.obj");
  for (const std::string out : {"out.glb", "out.gltf"}) {
    files.done("deform packed.gltf box.obj --pose box.obj -o " + out);
    CHECK(formats::read(files / out).surface.positions.size() == 16);  // this reader refuses compressed files
    CHECK_FALSE(mentions(file_bytes(files / out), "compression"));
  }
  CHECK(mentions(run("info " + quoted(files / "packed.gltf"), "VIETE_IMPORT=/bin/none"),
                 "install Draco (libdraco-dev)"));
}

TEST_CASE("extensions_are_taken_in_capitals_too") {
  const SmallFiles files;
  files.done("render model.obj --size 64x64 -o A.PNG");
  CHECK(test::read_png(files / "A.PNG").width == 64);
  files.done("deform model.obj cage.obj --pose pose.obj -o A.OBJ");
  fs::rename(files / "s.viete", files / "S.VIETE");
  files.done("render S.VIETE --size 64x64 -o b.png");
}
