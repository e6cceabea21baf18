// SPDX-License-Identifier: GPL-3.0-or-later
// Every question, searched by processes that form by themselves what they are told: the answer and
// its proofs are those of one process.
#include "codegen/answer/rank_question.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <semaphore>
#include <sstream>
#include <thread>

#include "codegen/answer/ask.hpp"
#include "codegen/model/request.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/simulated_workers.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using Json = nlohmann::ordered_json;

/// det J⁻¹ = x² + y² − 1, and x is hardly uncertain. The way is a ring around the singular circle.
constexpr const char* kRing = R"toml(regulus = 1
name = "ring"
[pose]
x = "m"
y = "m"
[geometry]
a = { value = 1, tolerance = 1e-9, group = "a" }
[matrix]
twist = ["v_x", "v_y"]
rows = [["x^2 + y^2 - a", 0], [0, 1]]
[load.push]
wrench = [1, 0]
[actuators]
force = [-4000, 4000]
[motion.way]
waypoints = "ring.csv"
[motion.dip]
waypoints = "dip.csv"
[motion.far]
waypoints = "far.csv"
)toml";

constexpr int kPoints = 6000, kDip = 4321;
constexpr double kRadius = 1.0003;

/// Processes that have the words and the model of the one that asks, and none of its kernels. Their
/// messages are late, lost or repeated, and they die.
class FormingRanks final : public cluster::Workers {
 public:
  FormingRanks(const Asked& asked, const Services& services, unsigned seed)
      : asked_(asked), services_(services), seed_(seed) {}

  void turn_to(std::string topic) override { topic_ = std::move(topic); }
  void begin(const Problem& problem, const Settings& settings, const cluster::Learned& learned,
             const cluster::MakeDecider& make) override {
    description_ = cluster::read_search(cluster::write_search(problem, settings, learned));
    formed_ = prepare_for_rank(asked_, services_, topic_);
    ASSERT_TRUE(formed_);
    topics.push_back(topic_ ? read_topic(*topic_) : SearchTopic{});
    known_.clear();
    const auto decide = [&](const Problem& own, const Settings& of_search,
                            const cluster::MakeDecider& own_make) {
      EXPECT_EQ(own.outer, problem.outer);
      EXPECT_EQ(own.kernel == nullptr, problem.kernel == nullptr);
      if (problem.kernel != nullptr) {
        EXPECT_EQ(own.kernel->variables, problem.kernel->variables);
        EXPECT_NE(own.kernel, problem.kernel);
      }
      EXPECT_EQ(bool(own_make), bool(make));
      Troubles troubles;
      if (seed_ % 2 == 1) troubles = {0.02, 0.05, 0.01, 40};
      workers_ = std::make_unique<SimulatedWorkers>(1 + seed_ % 5, troubles, seed_, known_);
      workers_->begin(own, of_search, description_.learned, own_make);
      begun_.release();
      ended_.acquire();
    };
    // It does not return until the search has ended; the two threads never work at once.
    deciding_ = std::thread([this, decide] { formed_->decide_for_another(description_, decide); });
    begun_.acquire();
  }
  /// A search that was too short has not begun.
  void end() noexcept override {
    if (!deciding_.joinable()) return;
    units += known_.size();
    ended_.release();
    deciding_.join();
  }
  [[nodiscard]] std::size_t count() const override { return workers_->count(); }
  [[nodiscard]] double seconds_of_grant() const override { return workers_->seconds_of_grant(); }
  [[nodiscard]] double now() const override { return workers_->now(); }
  void send(std::size_t worker, std::string grant) override {
    workers_->send(worker, std::move(grant));
  }
  [[nodiscard]] std::optional<cluster::Received> receive() override { return workers_->receive(); }

  std::vector<SearchTopic> topics;  ///< of the searches that were shared
  std::size_t units = 0;            ///< that were decided

 private:
  const Asked asked_;
  const Services services_;
  const unsigned seed_;
  std::optional<std::string> topic_;
  std::unique_ptr<RankQuestion> formed_;
  cluster::SearchDescription description_;
  std::binary_semaphore begun_{0}, ended_{0};
  std::thread deciding_;
  KnownOutcomes known_;
  std::unique_ptr<SimulatedWorkers> workers_;
};

/// Leaves out what is different in each run.
void forget_course(Json& report) {
  for (const char* key : {"seconds", "certificate", "threads"})
    if (report.is_object()) report.erase(key);
  for (Json& part : report)
    if (part.is_structured()) forget_course(part);
}

class QuestionsOfRanks : public testing::Test {
 protected:
  QuestionsOfRanks() {
    write("ring.toml", kRing);
    write("ring.csv", way(kPoints, kRadius));
    write("dip.csv", way(kPoints, kRadius, kDip));
    write("far.csv", way(100, 3));
  }

  [[nodiscard]] ModelOptions model(const std::string& motion) const {
    ModelOptions options;
    options.path = directory_.path() / "ring.toml";
    options.motion = motion;
    return options;
  }
  [[nodiscard]] ModelOptions tube() const {
    ModelOptions options = model("way");
    options.tubes = {"x=0:0.0001"};
    return options;
  }
  [[nodiscard]] static SearchOptions search() {
    SearchOptions options;
    options.engine = Engine::kInterpreted;
    options.boxes_before_compiling = 0;
    options.threads = 1;
    return options;
  }

  /// What an answer and its files say, without what is different in each run.
  [[nodiscard]] std::string answer_of(Asked asked, cluster::Workers* workers) const {
    std::visit([workers](auto& one) { one.search.workers = workers; }, asked);
    std::filesystem::remove_all(proofs());
    std::filesystem::create_directory(proofs());
    const std::unique_ptr<Answer> answer = ask(asked, services());
    Json report = answer->json();
    forget_course(report);
    std::string text = answer->headline() + '\n' + report.dump() + '\n';
    std::map<std::string, std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(proofs())) {
      std::ostringstream bytes;
      bytes << std::ifstream(file.path(), std::ios::binary).rdbuf();
      files[file.path().filename()] = bytes.str();
    }
    for (const auto& [name, bytes] : files) text += name + '\n' + bytes;
    return text;
  }

  /// Asks one process, then processes with and without troubles. Returns the topics of the searches
  /// that they shared.
  std::vector<SearchTopic> expect_same(const Asked& asked) const {
    const std::string alone = answer_of(asked, nullptr);
    std::vector<SearchTopic> topics;
    for (const unsigned seed : {2U, 3U}) {
      FormingRanks ranks(asked, services(), seed);
      EXPECT_TRUE(answer_of(asked, &ranks) == alone) << "seed " << seed;
      EXPECT_GT(ranks.topics.size(), 0U);
      EXPECT_GT(ranks.units, 32U);
      topics = ranks.topics;
    }
    return topics;
  }

 private:
  [[nodiscard]] std::filesystem::path proofs() const { return directory_.path() / "proofs"; }

  [[nodiscard]] Services services() const {
    Services services;
    services.certificate = proofs() / "proof";
    return services;
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_.path() / name) << text;
  }

  /// `dip`: a point within the singular circle.
  static std::string way(int points, double radius, int dip = -1) {
    std::ostringstream text;
    text.precision(12);
    text << "x,y\n";
    for (int i = 0; i <= points; ++i) {
      const double angle = 6.2 * i / points, r = i == dip ? 0.9999 : radius;
      text << r * std::cos(angle) << ',' << r * std::sin(angle) << '\n';
    }
    return text.str();
  }

  const TemporaryDirectory directory_;
};

TEST_F(QuestionsOfRanks, CheckAWay) {
  const auto topics = expect_same(AskCheck{model("way"), search()});
  EXPECT_FALSE(topics.front().piece);
}

/// The pieces after the singular one are not searched alone.
TEST_F(QuestionsOfRanks, CheckAWayWithASingularPose) {
  expect_same(AskCheck{model("dip"), search()});
}

TEST_F(QuestionsOfRanks, PaveAWay) { expect_same(AskPaving{model("dip"), search()}); }

TEST_F(QuestionsOfRanks, FindTheLargestTubeOfAWay) {
  for (const SearchTopic& topic : expect_same(AskMargin{tube(), search(), {}, {}, {}, "0.9"}))
    EXPECT_TRUE(topic.value);
}

TEST_F(QuestionsOfRanks, BoundAQuantityOfAWay) {
  const auto topics =
      expect_same(AskBound{model("way"), search(), {.quantity = "sigma-min"}, {}, "0.5"});
  EXPECT_EQ(topics.front().low, 0);
}

TEST_F(QuestionsOfRanks, CompareAQuantityOfAWayWithALimit) {
  expect_same(AskBound{model("way"), search(), {.quantity = "sigma-min"}, "0.0002"});
}

TEST_F(QuestionsOfRanks, BoundTheConditionNumberOfAWay) {
  SearchOptions options = search();
  options.max_boxes = 20000;
  const auto topics = expect_same(
      AskBound{model("far"), options, {.quantity = "condition", .norm = "2"}, {}, "1e-9"});
  EXPECT_NE(topics.front().kind, TopicKind::kQuestion);
}

TEST_F(QuestionsOfRanks, CheckALoadAlongAWay) { expect_same(AskLoad{model("way"), search()}); }

TEST_F(QuestionsOfRanks, PaveAWayForALoad) { expect_same(AskLoadPaving{model("dip"), search()}); }

/// The equations of a platform in the plane have a kernel, those of one in space have none.
TEST_F(QuestionsOfRanks, SolveAtOnePlace) {
  AskSolve plane{{}, search()}, followed{{}, search()}, space{{}, search()};
  plane.model.text =
      "regulus = 1\nname = \"parallelogram\"\n[legs]\ntype = \"RPR\"\nleg = [\n"
      "{ base = [0, 0], platform = [0, 0] },\n{ base = [3, 0], platform = [3, 0] },\n"
      "{ base = [1, 2], platform = [1, 2] },\n]\n[motion.curve]\nlegs = [1, 1, 1]\n";
  plane.search.max_boxes = 19000;
  for (const SearchTopic& topic : expect_same(plane)) EXPECT_EQ(topic.piece, 0U);
  followed.model.path = REGULUS_SOURCE_DIR "/models/rpr_6.toml";
  followed.model.tolerances = {"base=0.5"};
  followed.search.max_boxes = 21000;
  EXPECT_EQ(expect_same(followed).back().piece, 1U);
  space.model.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
  space.model.at = {"x=1", "y=2", "z=47", "psi=0.1", "theta=0.12", "phi=0.05"};
  space.model.tolerances = {"base=0.01"};
  space.search.max_boxes = 17500;
  for (const SearchTopic& topic : expect_same(space)) EXPECT_GE(topic.piece, 4U);
}

/// How long each row is searched depends on the time.
TEST_F(QuestionsOfRanks, MakeADatasheetOfAWay) {
  SearchOptions options = search();
  options.time_limit = 6;
  AskDatasheet asked{model("way"), options, "0.5"};
  FormingRanks ranks(asked, {}, 3);
  asked.search.workers = &ranks;
  const Json report = ask(asked, {})->json();
  ASSERT_GT(ranks.topics.size(), 0U);
  for (const SearchTopic& topic : ranks.topics)
    EXPECT_TRUE(!topic.part.empty() || topic.kind != TopicKind::kQuestion);
  const double largest = 1 / (kRadius * kRadius - 1);  // the force of leg 1, at the way-points
  const Json& force = report["bounds"][0]["components"][0];
  EXPECT_LE(force["attained"], largest * (1 + 1e-3)) << force;
  if (force["proved"].is_number()) {
    EXPECT_GE(force["proved"], largest) << force;
  }
}

TEST_F(QuestionsOfRanks, HaveNoTopicOfAnotherQuestion) {
  const Asked check = AskCheck{model("way"), search()};
  const Asked bound = AskBound{model("way"), search(), {.quantity = "sigma-min"}};
  const Asked margin = AskMargin{tube(), search(), {}};
  const Asked sheet = AskDatasheet{model("way"), search()};
  for (const Asked* asked : {&check, &bound, &margin, &sheet})
    EXPECT_FALSE(prepare_for_rank(*asked, {}, std::nullopt)) << "there is no first topic";
  SearchTopic beyond, other;
  beyond.waypoints = read_request(model("way")).motion.trajectory->sha256;
  beyond.piece = kPoints;
  other.component = "leg 3";
  const auto form = [](const Asked& asked, const SearchTopic& topic) {
    static_cast<void>(prepare_for_rank(asked, {}, write_topic(topic)));
  };
  AskSolve solve{{}, search()};
  solve.model.path = REGULUS_SOURCE_DIR "/models/dietmaier.toml";
  EXPECT_FALSE(prepare_for_rank(solve, {}, std::nullopt));
  EXPECT_THROW(form(solve, beyond), cluster::MalformedMessage) << "there is no such system";
  EXPECT_THROW(form(check, beyond), cluster::MalformedMessage);
  EXPECT_THROW(form(check, other), InputError) << "it is about other way-points";
  EXPECT_THROW(form(bound, other), cluster::MalformedMessage);
  EXPECT_THROW(form(margin, {}), cluster::MalformedMessage) << "it has no value";
  EXPECT_THROW(form(sheet, {}), cluster::MalformedMessage) << "it has no quantity";
}

}  // namespace
}  // namespace regulus::detail::test
