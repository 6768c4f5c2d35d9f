// What a station asks of the air and of the water's surface.

#include "messages_out.hpp"
#include "read_places.hpp"
#include "station.hpp"

namespace pelagos {

using proto::v1::Error;
using proto::v1::Request;
using proto::v1::ServerMessage;

void Station::answer_wind_query(const Request& request) {
  TextRefusals faults;
  const std::vector<Eigen::Vector3d> places = read_places(FieldReader(request, faults).child("query_wind"));
  if (!faults.empty()) return refuse_values(request.id(), faults);
  ServerMessage reply;
  reply.mutable_response()->set_id(request.id());
  *reply.mutable_response()->mutable_wind_reading() = to_message(context_.hooks.read_air(places));
  send(reply);
}

namespace {

ServerMessage reply_to(std::uint64_t id, const SurfaceNews& news) {
  if (!news.refusal.empty()) return error_message(id, Error::REFUSED, news.refusal);
  ServerMessage reply;
  reply.mutable_response()->set_id(id);
  *reply.mutable_response()->mutable_surface_answer() = to_message(news.answer);
  return reply;
}

}  // namespace

void Station::answer_surface_query(const Request& request) {
  TextRefusals faults;
  const FieldReader reader = FieldReader(request, faults).child("query_surface");
  const SurfaceQuery query = read_surface_query(request.query_surface(), reader);
  if (!faults.empty()) return refuse_values(request.id(), faults);
  const Reply reply = expect_reply();
  std::optional<Refusal> refusal;
  try {
    refusal = context_.hooks.ask_surface(query, name_,
                                         [give = reply_later(reply), id = request.id()](const SurfaceNews& news) {
                                           give(reply_to(id, news), !news.refusal.empty());
                                         });
  } catch (...) {
    replies_.pop_back();
    throw;
  }
  if (!refusal) return;
  if (refusal->field.empty()) return settle(reply, error_message(request.id(), Error::REFUSED, refusal->what));
  replies_.pop_back();
  reader.fault(*refusal);
  refuse_values(request.id(), faults);
}

}  // namespace pelagos
