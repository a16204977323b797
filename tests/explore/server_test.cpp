// The service: what it answers, and whom.
#include "explore/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "explore/explored.hpp"
#include "explore/linear_curves.hpp"

namespace gearsweep::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

struct Record {
  std::array<double, 8> head{};
  std::vector<double> numbers;
};

std::vector<Record> read_records(const std::string& bytes) {
  std::vector<Record> records;
  for (std::size_t at = 0; at < bytes.size();) {
    Record record;
    std::memcpy(record.head.data(), bytes.data() + at, sizeof(record.head));
    record.numbers.resize(static_cast<std::size_t>(record.head[4]));
    at += sizeof(record.head);
    std::memcpy(record.numbers.data(), bytes.data() + at, record.numbers.size() * sizeof(double));
    at += record.numbers.size() * sizeof(double);
    records.push_back(std::move(record));
  }
  return records;
}

class ServerTest : public ::testing::Test {
 protected:
  ServerTest() : ServerTest(explored(), std::nullopt) {}
  ServerTest(const ExploredStudy& study, std::optional<ExploredCurves> curves)
      : explorer_(
            study,
            {.source = "test", .is_model = false, .devices = {}, .curves = std::move(curves)}),
        client_("127.0.0.1", port()) {
    client_.set_read_timeout(60);
  }
  ~ServerTest() override { stop_ = true; }

  int port() const {
    const std::string& address = server_.address();
    return std::stoi(address.substr(std::string("http://127.0.0.1:").size()));
  }
  // "/TOKEN/"
  std::string path(const std::string& name) const {
    const std::string& address = server_.address();
    return address.substr(address.find('/', std::string("http://").size())) + name;
  }
  std::string key() { return json::parse(client_.Get(path("scene"))->body).at("key"); }
  httplib::Result post(const json& body) {
    return client_.Post(path("tiles"), body.dump(), "application/json");
  }

  Explorer explorer_;
  ExploreServer server_{&explorer_, 0};
  std::atomic<bool> stop_ = false;
  std::jthread thread_{[this] { server_.serve(stop_); }};
  httplib::Client client_;
};

TEST(Server, IsStoppedBeforeItHasBegun) {
  Explorer explorer(explored(), {.source = "test", .is_model = false, .devices = {}});
  ExploreServer(&explorer, 0).serve(std::atomic<bool>(true));
}

TEST_F(ServerTest, TellsWhatASceneHas) {
  const json scene = json::parse(client_.Get(path("scene?x=damping&set=omega%3D1.2"))->body);
  EXPECT_EQ(scene.at("axes")[0].at("name"), "damping");
  EXPECT_EQ(scene.at("axes")[1].at("name"), "amplitude");
  EXPECT_EQ(scene.at("quantities").size(), 3U);
  EXPECT_EQ(scene.at("quantities")[1].at("classes")[1], "periodic");
  EXPECT_GT(scene.at("choices").size(), 4U);
}

TEST_F(ServerTest, SendsTilesInTheOrderAskedFor) {
  const std::vector<Record> records = read_records(
      post({{"scene", key()}, {"page", "a"}, {"tiles", {{0, 0, 0}, {1, 1, 0}}}})->body);
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[1].head[0], 0.0);
  EXPECT_EQ(records[1].head[1], 1.0);
  EXPECT_EQ(records[1].head[2], 1.0);
  EXPECT_EQ(records[1].head[3], 0.0);
  EXPECT_EQ(records[1].head[4], 4.0 * 1024);
}

TEST_F(ServerTest, TellsTheMotionAtACellAndTheStudyOfAView) {
  const std::string scene = key();
  const json motion =
      json::parse(client_.Get(path("motion?depth=6&kx=20&ky=20&scene=" + scene))->body);
  EXPECT_EQ(motion.at("status"), "ok");
  EXPECT_EQ(motion.at("values").size(), 3U);
  EXPECT_EQ(motion.at("series").size(), motion.at("channels").size());
  EXPECT_THAT(client_.Get(path("study?x0=0.2&x1=0.3&nx=9&scene=" + scene))->body,
              HasSubstr("count = 9"));
}

// It would take a browser's click seconds.
TEST_F(ServerTest, CompressesNothing) {
  const httplib::Headers browser = {{"Accept-Encoding", "gzip, deflate, br"}};
  const auto motion = client_.Get(path("motion?depth=6&kx=20&ky=20&scene=" + key()), browser);
  EXPECT_FALSE(motion->has_header("Content-Encoding"));
  EXPECT_GT(json::parse(motion->body).at("series").size(), 0U);
  EXPECT_FALSE(client_.Get(path("app.js"), browser)->has_header("Content-Encoding"));
}

// What a page shows can be had by a command: with what was set, and with a value for an axis of the
// study that the page has replaced.
TEST_F(ServerTest, GivesCommandsForWhatItShows) {
  const json scene =
      json::parse(client_.Get(path("scene?x=damping&set=cubic%3D0.9&set=v%3D0.5"))->body);
  EXPECT_THAT(scene.at("command").get<std::string>(),
              HasSubstr("gearsweep run test --set 'parameters.cubic=0.9' --set "
                        "'initial={policy = \"fixed\", state = {x = 0, v = 0.5}}'"));
  const json motion = json::parse(
      client_.Get(path("motion?depth=6&kx=20&ky=20&scene=") + scene.at("key").get<std::string>())
          ->body);
  const std::string trace = motion.at("commands")[0];
  EXPECT_THAT(trace, HasSubstr("--set 'parameters.cubic=0.9'"));
  EXPECT_THAT(trace, HasSubstr("--at damping="));
  EXPECT_THAT(trace, HasSubstr(",omega=1"));
  EXPECT_THAT(scene.at("notices").dump(), HasSubstr("every point starts from the same state"));
}

TEST_F(ServerTest, SendsAPreviewAndStrips) {
  const std::string scene = key();
  const auto records = [&](const std::string& name, json body) {
    body["scene"] = scene;
    body["page"] = "a";
    return read_records(client_.Post(path(name), body.dump(), "application/json")->body);
  };
  const auto preview = records("preview", {{"view", {0.25, 0.25, 0.5, 0.5}}});
  // The first, whose time is that of its compiler, and a finer one.
  ASSERT_GE(preview.size(), 2U);
  EXPECT_EQ(preview[0].head[0], 2.0);
  EXPECT_EQ(std::fmod(preview[0].head[4], 4.0 * preview[0].head[7]), 0.0);
  EXPECT_EQ(preview[1].head[1], preview[0].head[1] + 1);
  const auto strips =
      records("diagram", {{"axis", 1}, {"at", {6, 30}}, {"strips", {{0, 0}, {2, 1}}}});
  ASSERT_EQ(strips.size(), 2U);
  EXPECT_EQ(strips[1].head[0], 3.0);
  EXPECT_EQ(strips[1].head[1], 2.0);
  EXPECT_EQ(strips[1].head[2], 1.0);
  EXPECT_EQ(strips[1].head[3], 1.0);
  EXPECT_EQ(strips[1].head[4], 128 * (4 + 2 * strips[1].head[7]));
}

TEST_F(ServerTest, TellsTheOrbitAndWhereOtherStartsLead) {
  const std::string at = "?depth=6&kx=20&ky=20&scene=" + key();
  const json orbit = json::parse(client_.Get(path("multipliers" + at))->body);
  EXPECT_EQ(orbit.at("values").size(), 2U);
  const json starts = json::parse(client_.Get(path("attractors" + at + "&starts=8"))->body);
  EXPECT_EQ(starts.at("starts"), 8);
  double share = starts.at("undecided").get<double>() + starts.at("diverged").get<double>();
  for (const json& attractor : starts.at("attractors"))
    share += attractor.at("share").get<double>();
  EXPECT_NEAR(share, 1.0, 1e-12);
}

TEST_F(ServerTest, RefusesAFloodAndGoesOn) {
  const std::string scene = key();
  json many = json::array();
  for (int i = 0; i < 512; ++i) many.push_back({6, i % 32, i / 32});
  constexpr int kRequests = 40;
  std::atomic<int> refused = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  {
    std::vector<std::jthread> flood;
    for (int i = 0; i < kRequests; ++i) {
      // So few connections may wait to be taken that more at one moment are reset.
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      flood.emplace_back([&, i] {
        httplib::Client other("127.0.0.1", port());
        other.set_read_timeout(60);
        httplib::Request request;
        request.method = "POST";
        request.path = path("tiles");
        request.body =
            json({{"scene", scene}, {"page", std::to_string(i)}, {"tiles", many}}).dump();
        // Those that are served go on until all have asked.
        request.content_receiver = [&](const char*, std::size_t, std::uint64_t, std::uint64_t) {
          std::this_thread::sleep_until(end);
          return false;
        };
        request.response_handler = [&](const httplib::Response& response) {
          if (response.status == 429) ++refused;
          return true;
        };
        static_cast<void>(other.send(request));
      });
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_EQ(client_.Get(path("scene"))->status, 200);
}

TEST_F(ServerTest, AnswersNobodyWithoutItsToken) {
  for (const char* other :
       {"/", "/scene", "/0123456789abcdef0123456789abcdef/scene", "/../etc/passwd"}) {
    EXPECT_EQ(client_.Get(other)->status, 403) << other;
  }
}

// A page elsewhere, or a name that was made to point here.
TEST_F(ServerTest, AnswersNoOtherPagesScript) {
  EXPECT_EQ(client_.Get(path("scene"), {{"Origin", "http://example.org"}})->status, 403);
  EXPECT_EQ(client_.Get(path("scene"), {{"Host", "example.org"}})->status, 403);
  const auto own = client_.Get(path("scene"));
  EXPECT_EQ(own->status, 200);
  EXPECT_THAT(own->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'self'"));
  EXPECT_FALSE(own->has_header("Access-Control-Allow-Origin"));
}

TEST_F(ServerTest, RefusesWhatIsWrongAndGoesOn) {
  const std::string scene = key();
  const auto status = [&](const std::string& name) { return client_.Get(path(name))->status; };
  EXPECT_EQ(status("scene?set=nothing%3D1"), 400);
  EXPECT_EQ(status("scene?set=omega"), 400);
  EXPECT_EQ(status("scene?x=nothing"), 400);
  EXPECT_EQ(status("motion?scene=unknown"), 404);
  EXPECT_EQ(status("motion?depth=99&scene=" + scene), 400);
  EXPECT_EQ(status("motion?depth=3&kx=9&scene=" + scene), 400);
  EXPECT_EQ(status("motion?depth=1e3&scene=" + scene), 400);
  EXPECT_EQ(status("study?x0=nan&scene=" + scene), 400);
  EXPECT_EQ(status("study?nx=99999999&scene=" + scene), 400);
  EXPECT_EQ(status("nothing.js"), 404);
  EXPECT_EQ(client_.Post(path("tiles"), "{", "application/json")->status, 400);
  EXPECT_EQ(client_.Post(path("tiles"), std::string(1 << 20, '['), "application/json")->status,
            413);
  EXPECT_EQ(post({{"scene", scene}, {"page", "a"}, {"tiles", {{0, 1, 0}}}})->status, 400);
  EXPECT_EQ(post({{"scene", scene}, {"page", "a"}, {"tiles", {{99, 0, 0}}}})->status, 400);
  EXPECT_EQ(post({{"scene", scene}, {"page", "a"}, {"tiles", {{0, -1, 0}}}})->status, 400);
  EXPECT_EQ(
      post({{"scene", scene}, {"page", "a"}, {"tiles", json(std::vector(513, json({0, 0, 0})))}})
          ->status,
      400);
  const auto refused = [&](const std::string& name, const json& body) {
    return client_.Post(path(name), body.dump(), "application/json")->status;
  };
  const json whole = {{"scene", scene}, {"page", "a"}};
  const auto with = [&](json more) {
    more.update(whole);
    return more;
  };
  EXPECT_EQ(refused("preview", with({{"view", {0.5, 0.0, 0.5}}})), 400);
  EXPECT_EQ(refused("preview", with({{"view", "all"}})), 400);
  EXPECT_EQ(refused("diagram", with({{"axis", 2}, {"at", {1, 1}}, {"strips", {{0, 0}}}})), 400);
  EXPECT_EQ(refused("diagram", with({{"axis", 0}, {"at", {1, 3}}, {"strips", {{0, 0}}}})), 400);
  EXPECT_EQ(refused("diagram", with({{"axis", 0}, {"at", {1, 1}}, {"strips", {{1, 1}}}})), 400);
  EXPECT_EQ(status("attractors?starts=1&scene=" + scene), 400);
  EXPECT_EQ(status("attractors?starts=1000000&scene=" + scene), 400);
  EXPECT_EQ(status("data?scene=" + scene), 404);
  EXPECT_EQ(status("scene"), 200);
}

TEST_F(ServerTest, EndsAPagesStreamWhenItAsksAnew) {
  const std::string scene = key();
  json many = json::array();
  for (int i = 0; i < 512; ++i) many.push_back({6, i % 32, i / 32});
  std::atomic<std::size_t> bytes = 0;
  std::jthread first([&] {
    httplib::Client other("127.0.0.1", port());
    other.set_read_timeout(60);
    const json body = {{"scene", scene}, {"page", "a"}, {"tiles", many}};
    bytes = other.Post(path("tiles"), body.dump(), "application/json")->body.size();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  post({{"scene", scene}, {"page", "a"}, {"tiles", {{0, 0, 0}}}});
  first.join();
  EXPECT_LT(bytes, std::size_t{512} * (64 + 4 * 1024 * 8));
}

ExploredCurves linear_curves() {
  const Folder folder;
  return read_explored_curves(write_linear_curves(folder), explored(kLinear).study);
}

class CurveServerTest : public ServerTest {
 protected:
  CurveServerTest() : ServerTest(explored(kLinear), linear_curves()) {}
  json scene(const std::string& query) {
    return json::parse(client_.Get(path("scene" + query))->body);
  }
  int status(const std::string& name) { return client_.Get(path(name))->status; }
};

// In curves_test.cpp is what they say.
TEST_F(CurveServerTest, HasTheCurvesOfItsPlane) {
  const std::string own = scene("").at("key"), turned = scene("?x=amplitude&y=omega").at("key");
  const json curves = json::parse(client_.Get(path("curves"))->body);
  EXPECT_EQ(curves.at("curves").size(), 2U);
  EXPECT_EQ(status("border?curve=0&point=2&scene=" + own), 200);
  EXPECT_EQ(status("border?curve=1&point=1&scene=" + turned), 200);
  EXPECT_EQ(status("border?curve=2&point=0&scene=" + own), 400);
  EXPECT_EQ(status("border?curve=0&point=5&scene=" + own), 400);
  EXPECT_EQ(status("border?curve=-1&point=0&scene=" + own), 400);
  EXPECT_EQ(status("border?curve=0&point=0&scene=unknown"), 404);
}

TEST_F(CurveServerTest, SaysWhyThereAreNoneInAnother) {
  const json moved = scene("?set=damping%3D0.3"), elsewhere = scene("?y=linear");
  for (const char* same : {"", "?x=amplitude&y=omega", "?set=x%3D0.5"}) {
    EXPECT_EQ(scene(same).at("has_curves"), true) << same;
    EXPECT_EQ(scene(same).at("curves_note"), "") << same;
  }
  EXPECT_EQ(moved.at("has_curves"), false);
  EXPECT_EQ(moved.at("curves_note"),
            "curves are not shown: they are of damping = 0.2, the map is of damping = 0.3");
  EXPECT_EQ(elsewhere.at("has_curves"), false);
  EXPECT_EQ(status("border?curve=0&point=2&scene=" + moved.at("key").get<std::string>()), 404);
}

TEST_F(ServerTest, HasNoCurvesWithoutAFile) {
  const json scene = json::parse(client_.Get(path("scene"))->body);
  EXPECT_EQ(scene.at("has_curves"), false);
  EXPECT_EQ(scene.at("curves_note"), "");
  EXPECT_EQ(client_.Get(path("curves"))->status, 404);
  EXPECT_EQ(client_.Get(path("border?curve=0&point=0&scene=" + key()))->status, 404);
}

}  // namespace
}  // namespace gearsweep::testing
