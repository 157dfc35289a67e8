// Results shared by several machines, in a folder and on a server: two caches that share nothing else.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>
#include <thread>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

class UpstreamCli : public testing::Test {
 protected:
  UpstreamCli() { fs::create_directory(shared); }

  /// On a machine with a cache of its own.
  ProcessResult ballflow(const std::string& machine, std::vector<std::string> arguments,
                         std::map<std::string, std::string> environment = {}) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    environment["BALLFLOW_CACHE"] = folder.file("cache of " + machine);
    return test::run_process(arguments, environment);
  }
  ProcessResult sweep(const std::string& machine, const std::string& upstream,
                      std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{
        "sweep", test::source_file("graphs/shape.json"), "--axis", "shape=torus,box", "--axis", "n=300,400",
        "--out", folder.file("out of " + machine)};
    if (!upstream.empty()) arguments.insert(arguments.end(), {"--upstream", upstream});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ballflow(machine, std::move(arguments));
  }
  /// How many nodes of the last run of a machine have this status.
  int count(const std::string& machine, const std::string& status) {
    int n = 0;
    const json report = json::parse(test::read_file(folder.file("out of " + machine + "/report.json")));
    for (const auto& [path, node] : report.at("nodes").items()) n += node.at("status") == status ? 1 : 0;
    return n;
  }
  /// The output files of a machine, without what has times in it.
  std::map<std::string, std::string> files(const std::string& machine) {
    std::map<std::string, std::string> found;
    const fs::path out = folder.file("out of " + machine);
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
      if (entry.is_regular_file() && entry.path().extension() == ".ply")
        found[fs::relative(entry.path(), out).string()] = test::read_file(entry.path().string());
    }
    return found;
  }

  const test::TempFolder folder;
  const std::string shared = folder.file("group share");
};

TEST_F(UpstreamCli, another_machine_computes_nothing_and_has_the_same_files) {
  const ProcessResult first = sweep("a", shared);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.err.find("warning"), std::string::npos) << first.err;
  EXPECT_GT(count("a", "run"), 0);
  const ProcessResult second = sweep("b", shared);
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(count("b", "run"), 0);
  EXPECT_EQ(files("a"), files("b"));
  EXPECT_FALSE(files("a").empty());
}

TEST_F(UpstreamCli, plan_and_exec_node_look_upstream_and_the_environment_names_it) {
  const std::string graph = test::source_file("graphs/shape.json");
  const std::map<std::string, std::string> environment{{"BALLFLOW_UPSTREAM", shared}};
  const ProcessResult made =
      ballflow("a", {"run", graph, "--set", "n=300", "--report", folder.file("a.json")}, environment);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProcessResult before = ballflow("b", {"plan", graph, "--set", "n=300"});
  EXPECT_NE(before.out.find("RUN"), std::string::npos) << before.out;
  const ProcessResult after = ballflow("b", {"plan", graph, "--set", "n=300"}, environment);
  EXPECT_EQ(after.exit_code, 0) << after.err;
  EXPECT_EQ(after.out.find("RUN"), std::string::npos) << after.out;
  EXPECT_NE(after.out.find("HIT"), std::string::npos) << after.out;
  // A mesh that only the upstream has, by its digest.
  std::string mesh;
  const json report = json::parse(test::read_file(folder.file("a.json")));
  for (const auto& [path, node] : report.at("nodes").items()) {
    for (const auto& [port, output] : node.at("outputs").items()) {
      if (output.at("type") == "TriangleMesh") mesh = output.at("digest");
    }
  }
  ASSERT_FALSE(mesh.empty()) << report.dump(1);
  const std::vector<std::string> call{"exec-node", "SolidTopology", "--input", "mesh=" + mesh};
  EXPECT_EQ(ballflow("c", call).exit_code, 2);
  const ProcessResult called = ballflow("c", call, environment);
  EXPECT_EQ(called.exit_code, 0) << called.err;
}

TEST_F(UpstreamCli, what_cannot_be_is_said_before_anything_runs) {
  const ProcessResult absent = sweep("a", folder.file("nowhere"));
  EXPECT_EQ(absent.exit_code, 5);
  EXPECT_NE(absent.err.find("there is no upstream folder"), std::string::npos) << absent.err;
  const ProcessResult both = sweep("a", shared, {"--no-cache"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_NE(both.err.find("--upstream needs the cache"), std::string::npos) << both.err;
  EXPECT_EQ(sweep("a", "http://host/path?query").exit_code, 2);
}

TEST_F(UpstreamCli, a_read_only_upstream_gets_nothing) {
  ASSERT_EQ(sweep("a", shared, {"--upstream-read-only"}).exit_code, 0);
  EXPECT_TRUE(fs::is_empty(shared));
}

TEST_F(UpstreamCli, parts_of_a_sweep_run_apart_and_give_the_whole) {
  ASSERT_EQ(sweep("whole", "").exit_code, 0);
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    const ProcessResult run = sweep("parts", shared, {"--shard", part, "--no-record"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }
  EXPECT_EQ(files("parts"), files("whole"));
  for (const char* report : {"report-1-3.json", "report-2-3.json", "report-3-3.json"})
    EXPECT_TRUE(fs::exists(folder.file("out of parts/" + std::string(report))));
  EXPECT_TRUE(fs::is_empty(folder.file("cache of parts/runs"))) << "no record";
  for (const char* part : {"0/3", "4/3", "3", "1/", "a/b", "5/5"})
    EXPECT_EQ(sweep("parts", shared, {"--shard", part}).exit_code, 2) << part;
}

TEST_F(UpstreamCli, damage_costs_time_and_no_results) {
  ASSERT_EQ(sweep("a", shared).exit_code, 0);
  int i = 0;
  for (const auto& entry : fs::recursive_directory_iterator(shared)) {
    if (!entry.is_regular_file()) continue;
    fs::permissions(entry.path(), fs::perms::owner_write, fs::perm_options::add);
    std::string bytes = test::read_file(entry.path().string());
    if (++i % 2 == 0) {
      bytes.resize(bytes.size() / 2);
    } else {
      bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    }
    test::write_file(entry.path().string(), bytes);
  }
  const ProcessResult second = sweep("b", shared);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(second.err.find("is damaged"), std::string::npos) << second.err;
  EXPECT_EQ(files("a"), files("b"));
  const ProcessResult third = sweep("c", shared);
  EXPECT_EQ(third.err.find("is damaged"), std::string::npos) << third.err;
  EXPECT_EQ(count("c", "run"), 0) << "the second machine made good what it found damaged";
}

TEST_F(UpstreamCli, collecting_removes_what_is_old_and_costs_time_only) {
  ASSERT_EQ(sweep("a", shared).exit_code, 0);
  const auto files_of = [this] {
    std::size_t n = 0;
    for (const auto& entry : fs::recursive_directory_iterator(shared)) n += entry.is_regular_file() ? 1 : 0;
    return n;
  };
  const std::size_t before = files_of();
  const auto collect = [this](std::vector<std::string> more) {
    more.insert(more.begin(), {"cache", "gc", "--upstream", shared});
    return ballflow("a", std::move(more));
  };
  // What says what is wrong, and removes nothing.
  for (const auto& [arguments, words] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{}, "--upstream needs --older-than"},
           {{"--older-than", "soon"}, "not an age"},
           {{"--older-than", "23h"}, "--nothing-runs"}}) {
    const ProcessResult refused = collect(arguments);
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
  }
  EXPECT_EQ(ballflow("a", {"cache", "gc", "--older-than", "1d"}).exit_code, 2) << "of which upstream?";
  EXPECT_EQ(collect({"--older-than", "1d", "--size", "1G"}).exit_code, 2);
  EXPECT_EQ(collect({"--older-than", "1d"}).exit_code, 0);
  EXPECT_EQ(files_of(), before) << "all of it is young";
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(50);
  for (const auto& entry : fs::recursive_directory_iterator(shared))
    if (entry.is_regular_file()) fs::last_write_time(entry.path(), long_ago);
  const ProcessResult dry = collect({"--older-than", "2d", "--dry-run"});
  EXPECT_EQ(dry.exit_code, 0) << dry.err;
  EXPECT_EQ(dry.out.find("would remove "), 0u) << dry.out;
  EXPECT_EQ(files_of(), before);
  const ProcessResult done = collect({"--older-than", "2d"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out.substr(std::string("removed").size()),
            dry.out.substr(std::string("would remove").size()));
  EXPECT_NE(done.out.find("0 entries (0 B) and 0 artifacts (0 B) are left"), std::string::npos) << done.out;
  EXPECT_EQ(files_of(), 0u);
  const ProcessResult after = sweep("b", shared);
  EXPECT_EQ(after.exit_code, 0) << after.err;
  EXPECT_EQ(files("a"), files("b"));
}

/// nginx on loopback, with its folder; stopped with the object.
class CacheServer {
 public:
  explicit CacheServer(const std::string& root) : root_(root) {
    fs::create_directories(root_ + "/data");
    fs::create_directories(root_ + "/tmp");
    // A port that is free now.
    const int probe = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(probe, reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size);
    ::close(probe);
    port_ = ntohs(address.sin_port);
    configure("access_log off;");
  }
  ~CacheServer() { stop(); }

  /// `log`: directives that say what is logged of requests.
  void configure(const std::string& log) const {
    test::write_file(root_ + "/nginx.conf",
                     "daemon off; master_process off; pid " + root_ + "/pid;\n" + "error_log " + root_ +
                         "/log;\nevents {}\nhttp {\n" + log + " client_max_body_size 0;\n" + temp_paths() +
                         "server { listen 127.0.0.1:" + std::to_string(port_) + "; root " + root_ +
                         "/data;\n" +
                         "location / { dav_methods PUT DELETE; create_full_put_path on; "
                         "} } }\n");
  }
  static bool is_installed() { return fs::exists("/usr/sbin/nginx"); }
  std::string address() const { return "http://127.0.0.1:" + std::to_string(port_) + "/ballflow"; }
  std::string data() const { return root_ + "/data/ballflow"; }
  bool start() {
    process_ = ::fork();
    if (process_ == 0) {
      const std::string conf = root_ + "/nginx.conf", log = root_ + "/log";
      ::execl("/usr/sbin/nginx", "nginx", "-e", log.c_str(), "-c", conf.c_str(), nullptr);
      ::_exit(127);
    }
    for (int tries = 0; tries < 3000; ++tries) {
      const int probe = ::socket(AF_INET, SOCK_STREAM, 0);
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      address.sin_port = htons(port_);
      const bool up = ::connect(probe, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
      ::close(probe);
      if (up) return true;
      if (::waitpid(process_, nullptr, WNOHANG) == process_) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    process_ = -1;
    return false;
  }
  void stop() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

 private:
  std::string temp_paths() const {
    std::string text;
    for (const char* name : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
      text += std::string(name) + "_temp_path " + root_ + "/tmp/" + name + ";\n";
    return text;
  }

  std::string root_;
  int port_ = 0;
  pid_t process_ = -1;
};

TEST_F(UpstreamCli, two_workers_share_a_cache_server_and_nothing_else) {
  if (!CacheServer::is_installed()) GTEST_SKIP() << "nginx is not installed (Debian: nginx-light)";
  CacheServer server(folder.file("server"));
  ASSERT_TRUE(server.start()) << test::read_file(folder.file("server/log"));
  const ProcessResult first = sweep("a", server.address());
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.err.find("warning"), std::string::npos) << first.err;
  const ProcessResult second = sweep("b", server.address());
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(count("b", "run"), 0);
  EXPECT_EQ(files("a"), files("b"));

  // What a flipped bit makes of a blob is a miss, and is put right.
  const fs::path blob = fs::directory_iterator(server.data() + "/cas")->path();
  const std::string good = test::read_file(blob.string());
  std::string bad = good;
  bad[bad.size() - 1] = static_cast<char>(bad[bad.size() - 1] ^ 1);
  test::write_file(blob.string(), bad);
  const ProcessResult third = sweep("c", server.address());
  EXPECT_EQ(third.exit_code, 0) << third.err;
  EXPECT_EQ(files("a"), files("c"));
}

TEST_F(UpstreamCli, a_server_that_dies_costs_speed_and_no_results) {
  if (!CacheServer::is_installed()) GTEST_SKIP() << "nginx is not installed (Debian: nginx-light)";
  CacheServer server(folder.file("server"));
  ASSERT_TRUE(server.start()) << test::read_file(folder.file("server/log"));
  ASSERT_EQ(sweep("a", server.address()).exit_code, 0);
  server.stop();
  const ProcessResult dead = sweep("b", server.address());
  EXPECT_EQ(dead.exit_code, 0) << dead.err;
  EXPECT_NE(dead.err.find("does not answer"), std::string::npos) << dead.err;
  EXPECT_EQ(files("a"), files("b"));
  // What a server says that keeps nothing.
  fs::remove_all(server.data());
  test::write_file(server.data(), "a file where a folder should be");
  ASSERT_TRUE(server.start());
  const ProcessResult refusing = sweep("c", server.address());
  EXPECT_EQ(refusing.exit_code, 0) << refusing.err;
  EXPECT_NE(refusing.err.find("the server answers with status"), std::string::npos) << refusing.err;
  EXPECT_EQ(files("a"), files("c"));
}

TEST_F(UpstreamCli, a_server_that_is_killed_in_the_middle_of_a_sweep_costs_speed_and_no_results) {
  if (!CacheServer::is_installed()) GTEST_SKIP() << "nginx is not installed (Debian: nginx-light)";
  ASSERT_EQ(sweep("a", "").exit_code, 0);
  CacheServer server(folder.file("server"));
  // It writes a line for each request into a pipe that holds less than one, and waits for who reads it: so it
  // is known how far the sweep has come, however busy this machine is.
  const std::string log = folder.file("requests");
  ASSERT_EQ(::mkfifo(log.c_str(), 0600), 0);
  const int requests = ::open(log.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(requests, 0);
  const int capacity = ::fcntl(requests, F_SETPIPE_SZ, 4096);
  ASSERT_GE(capacity, 4096);
  std::string format = "log_format told '$request";
  for (int i = 0; i <= capacity / 500; ++i) format += "'\n '" + std::string(500, '.');
  server.configure(format + "';\naccess_log " + log + " told;");
  ASSERT_TRUE(server.start()) << test::read_file(folder.file("server/log"));

  std::future<ProcessResult> running =
      std::async(std::launch::async, [&] { return sweep("b", server.address()); });
  std::string told;
  const auto published = [&told] {
    int n = 0;
    for (std::size_t at = 0; (at = told.find("PUT /ballflow/ac/", at)) != std::string::npos; ++at) ++n;
    return n;
  };
  while (published() < 2 && running.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    pollfd ready{requests, POLLIN, 0};
    if (::poll(&ready, 1, 10) <= 0) continue;
    char text[4096];
    const ssize_t got = ::read(requests, text, sizeof text);
    if (got > 0) told.append(text, static_cast<std::size_t>(got));
  }
  server.stop();
  ::close(requests);
  const ProcessResult killed = running.get();
  EXPECT_EQ(killed.exit_code, 0) << killed.err;
  EXPECT_NE(killed.err.find("does not answer"), std::string::npos) << killed.err;
  EXPECT_EQ(files("a"), files("b"));
  const auto entries = [&server] {
    return std::distance(fs::directory_iterator(server.data() + "/ac"), fs::directory_iterator());
  };
  const auto kept = entries();
  EXPECT_GE(kept, 2);

  // What it kept is right, and what it lacks is published by the next machine.
  server.configure("access_log off;");
  ASSERT_TRUE(server.start()) << test::read_file(folder.file("server/log"));
  const ProcessResult next = sweep("c", server.address());
  EXPECT_EQ(next.exit_code, 0) << next.err;
  EXPECT_EQ(next.err.find("warning"), std::string::npos) << next.err;
  EXPECT_LT(count("c", "run"), count("b", "run"));
  EXPECT_EQ(files("a"), files("c"));
  EXPECT_GT(entries(), kept) << "it was killed before all was published";
  ASSERT_EQ(sweep("d", server.address()).exit_code, 0);
  EXPECT_EQ(count("d", "run"), 0);
}

}  // namespace
}  // namespace ballflow
