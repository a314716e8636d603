#include "app/file_desk.h"

#include "support/files.h"
#include "workspace/open_save.h"

using namespace viete;
using What = files::OpenRequest::What;

namespace {

using Result = app::Loader::Result;

Result loaded(app::Loader& loader, const files::OpenRequest& request,
              const document::Document& current = {}) {
  app::start_loading(loader, request, current);
  auto result = loader.poll(true);
  REQUIRE(result);
  return *std::move(result);
}

document::Document opened(app::Loader& loader, const files::OpenRequest& request) {
  const Result result = loaded(loader, request);
  REQUIRE_MESSAGE(result.value, result.problem);
  return result.value->opened.document.value();
}

}  // namespace

TEST_CASE("a_model_and_its_cage_come_with_look_and_binding_and_only_once") {
  const test::CubeFiles files;
  app::Loader loader;
  CHECK_FALSE(loader.poll(true));
  app::start_loading(loader, {What::model, {files.cage}}, {});
  app::start_loading(loader, {What::model, {files.model, files.cage}}, {});  // cancels the first request
  CHECK(loader.running());
  CHECK(loader.state().running);
  const auto result = loader.poll(true);
  REQUIRE(result);
  REQUIRE(result->value);
  const document::Document& document = result->value->opened.document.value();
  CHECK(document.model().path == files.model);
  CHECK(result->value->shading.surface == document.model().surface);
  CHECK(result->value->bound.binds(document));
  CHECK_FALSE(loader.running());
  CHECK_FALSE(loader.state().running);
  CHECK_FALSE(loader.poll(true));
}

TEST_CASE("only_changes_are_derived_again") {
  const test::CubeFiles files;
  app::Loader loader;
  const Result model = loaded(loader, {What::model, {files.model}});
  REQUIRE(model.value);
  CHECK(model.value->shading.surface);
  CHECK_FALSE(model.value->bound.binding);

  const Result cage = loaded(loader, {What::cage, {files.cage}}, *model.value->opened.document);
  REQUIRE(cage.value);
  CHECK_FALSE(cage.value->shading.surface);
  CHECK(cage.value->bound.binds(*cage.value->opened.document));

  const Result pose = loaded(loader, {What::pose, {files.pose}}, *cage.value->opened.document);
  REQUIRE(pose.value);
  CHECK(pose.value->opened.pose);
  CHECK_FALSE(pose.value->opened.document);
  CHECK_FALSE(pose.value->shading.surface);
  CHECK_FALSE(pose.value->bound.binding);
}

TEST_CASE("it_is_bound_as_what_is_open_or_as_the_session_says") {
  const test::CubeFiles files;
  app::Loader loader;
  document::Document current;
  pose::Deformer deformer = current.deformer();
  deformer.weighting = {pose::Elements::face, pose::Weights::cut_off, 0.3};
  current.put_deformer(deformer);
  const Result model = loaded(loader, {What::model, {files.model, files.cage}}, current);
  REQUIRE(model.value);
  CHECK(model.value->bound.binding->weighting.radius == 0.3);

  workspace::Workspace saved;
  saved.document = opened(loader, {What::model, {files.model, files.cage}});
  deformer.weighting.radius = 0.2;
  saved.document.put_deformer(deformer);
  REQUIRE(workspace::save_session(saved, files / "a.viete"));
  const Result session = loaded(loader, {What::model, {files / "a.viete"}}, current);
  REQUIRE(session.value);
  CHECK(session.value->bound.binding->weighting.radius == 0.2);
}
