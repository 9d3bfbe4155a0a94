// SPDX-License-Identifier: Apache-2.0
#include "apps/server/session_json.h"

#include "dismantle/export/viewer_model.h"

namespace dismantle::server {

namespace {

/// The recording or a guide: moves that follow one another, without their frames.
template <class Moves>
Json moves_json(const Moves& moves) {
  Json list = Json::array();
  double start = 0;
  for (const auto& move : moves) {
    const double duration = move.frames.back().time;
    list.push_back({{"label", move.label},
                    {"components", to_json(Span<const ComponentId>(move.components))},
                    {"start", start},
                    {"duration", duration}});
    start += duration;
  }
  return list;
}

Json playback_json(const Session& session) {
  const Playback* p = session.playback();
  if (p == nullptr) return nullptr;
  Json blocked;
  if (const auto& block = p->block())
    blocked = {{"time", block->time}, {"by", block->by.valid() ? Json(block->by.value) : Json(nullptr)}};
  return {{"source", p->source() == PlaybackSource::Guide ? "guide" : "recording"},
          {"time", p->time()},
          {"duration", p->timeline().duration()},
          {"speed", p->speed()},
          {"playing", p->is_playing()},
          {"move", p->position().move},
          {"blocked", std::move(blocked)}};
}

Json automatic_json(const Session& session) {
  if (session.activity() != SessionActivity::Automatic) return nullptr;
  return session.automatic() == AutomaticKind::TakeOut ? "take_out" : "put_back";
}

Json components_json(const Session& session) {
  Json list = Json::array();
  for (std::uint32_t i = 0; i < session.poses().size(); ++i) {
    Json one = Json::object();
    if (!(session.poses()[i] == Pose{})) one["pose"] = to_json(session.poses()[i]);
    if (session.visibility().is_hidden(ComponentId(i))) one["hidden"] = true;
    if (session.is_removed(ComponentId(i))) one["removed"] = true;
    list.push_back(std::move(one));
  }
  return list;
}

}  // namespace

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json to_json(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json to_json(const Pose& p) {
  return Json::array(
      {p.position.x, p.position.y, p.position.z, p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z});
}

Json to_json(Span<const ComponentId> components) {
  Json list = Json::array();
  for (const ComponentId c : components) list.push_back(c.value);
  return list;
}

Json model_json(const Model& model) {
  Json json = Json::parse(viewer_model_json(*model.assembly, model.session->pairs().tolerance));
  json["event"] = "model";
  json["number"] = model.number;
  if (!model.name.empty()) json["name"] = model.name;
  json["product"] = model.product;
  return json;
}

Json state_json(const Session& session) {
  Json json;
  json["components"] = components_json(session);
  json["isolated"] = session.visibility().is_isolated();
  json["moving"] = to_json(session.moving());
  json["automatic"] = automatic_json(session);
  json["response"] = name_of(session.response());
  json["responses"] = Json::array();
  for (const ResponseKind response : {ResponseKind::Slide, ResponseKind::Touch, ResponseKind::Stop})
    if (session.can_respond(response)) json["responses"].push_back(name_of(response));
  json["method"] = session.drag_engine().method;
  json["undo"] = session.done().empty() ? Json(nullptr) : Json(session.done()[session.done().size() - 1].label);
  json["redo"] = session.undone().empty() ? Json(nullptr) : Json(session.undone()[0].label);
  json["moves"] = moves_json(session.done());
  json["playback"] = playback_json(session);
  json["guide"] = nullptr;
  if (const Guide* guide = session.guide())
    json["guide"] = {{"name", guide->name}, {"moves", moves_json(guide->timeline.moves())}};
  return json;
}

Json clashes_json(const Clashes& clashes) {
  Json list = Json::array();
  for (const Clash& c : clashes.pairs)
    list.push_back({{"a", c.a.value},
                    {"b", c.b.value},
                    {"state", name_of(c.state)},
                    {"contained", c.contained.valid() ? Json(c.contained.value) : Json(nullptr)},
                    {"distance", c.distance},
                    {"depth", c.depth},
                    {"deepest_at", to_json(c.deepest_at)},
                    {"volume", c.volume}});
  return {{"tolerance", clashes.tolerance}, {"pairs", std::move(list)}};
}

}  // namespace dismantle::server
