// The service: what it answers, and whom.
#include "explore/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "explore/explored.hpp"

namespace gearsweep::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class ServerTest : public ::testing::Test {
 protected:
  ServerTest() : client_("127.0.0.1", port()) { client_.set_read_timeout(60); }
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

  Explorer explorer_{explored(), {.source = "test", .devices = {}}};
  ExploreServer server_{&explorer_, 0};
  std::atomic<bool> stop_ = false;
  std::jthread thread_{[this] { server_.serve(stop_); }};
  httplib::Client client_;
};

TEST(Server, IsStoppedBeforeItHasBegun) {
  Explorer explorer(explored(), {.source = "test", .devices = {}});
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
  const std::string body =
      post({{"scene", key()}, {"page", "a"}, {"tiles", {{0, 0, 0}, {1, 1, 0}}}})->body;
  constexpr std::size_t kRecord = 64 + 4 * 1024 * 8;
  ASSERT_EQ(body.size(), 2 * kRecord);
  std::array<double, 8> head{};
  std::memcpy(head.data(), body.data() + kRecord, sizeof(head));
  EXPECT_EQ(head[0], 0.0);
  EXPECT_EQ(head[1], 1.0);
  EXPECT_EQ(head[2], 1.0);
  EXPECT_EQ(head[3], 0.0);
  EXPECT_EQ(head[4], 4.0 * 1024);
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

}  // namespace
}  // namespace gearsweep::testing
