#include "gui/server.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <future>
#include <thread>
#include <vector>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "gui/http_fixture.hpp"

namespace phy::gui {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string token = "0123456789abcdef0123456789abcdef", file_token = "fedcba9876543210fedcba9876543210";

/// A server that echoes; "/slow" waits until it is released, "/broken" throws, "/file" is one.
class ServerTest : public InFolder {
 protected:
  std::atomic<bool> stop{false};
  std::atomic<int> n_handled{0};
  std::promise<void> released;
  const std::string file = write("file", std::string(3 << 20, 'x') + "end");
  Server server{0, {token, file_token}, [this](const Request& r) {
                  ++n_handled;
                  if (r.path == "/slow") released.get_future().wait_for(std::chrono::seconds(9));
                  if (r.path == "/broken") throw std::runtime_error("a reason");
                  std::string query;
                  for (const auto& [key, value] : r.query) query += key + "=" + value + ";";
                  if (r.path == "/file")
                    return Response{200, "text/html", "", std::make_shared<io::InputFile>(file)};
                  return Response{200, "text/plain", r.method + " " + r.path + " " + query + r.body};
                }};
  bool all_answered = false;
  std::thread runs{[this] { all_answered = server.run(stop); }};
  ~ServerTest() override {
    stop = true;
    runs.join();
  }

  std::string host() const { return fmt::format("Host: 127.0.0.1:{}\r\n", server.port()); }
  std::string known() const { return host() + "X-Phyllite-Token: " + token + "\r\n"; }
  Answer get(const std::string& target, const std::string& fields) const {
    return ask(server.port(), "GET " + target, fields);
  }
};

TEST_F(ServerTest, AnswersItsOwnPageAlone) {
  const std::string mine = fmt::format("http://127.0.0.1:{}", server.port());
  EXPECT_EQ(get("/a%20b?x=1+2&y=%26", known()).body, "GET /a b x=1 2;y=&;");
  EXPECT_EQ(get("/a?token=" + token, host()).body, "GET /a ");  // the handler does not see the token
  EXPECT_EQ(get("/a", known() + "Origin: " + mine + "\r\n").status, 200);
  EXPECT_EQ(ask(server.port(), "POST /a", known(), "some text").body, "POST /a some text");
  const std::string local =
      fmt::format("Host: localhost:{}\r\nX-Phyllite-Token: {}\r\n", server.port(), token);
  EXPECT_EQ(get("/a", local).status, 200);
}

TEST_F(ServerTest, RefusesEverybodyElse) {
  const std::string with_token = "X-Phyllite-Token: " + token + "\r\n";
  const std::string other_port = fmt::format("127.0.0.1:{}", server.port() == 9 ? 10 : 9);
  for (const std::string& fields :
       {host(), host() + "X-Phyllite-Token: " + token.substr(1) + "\r\n",
        host() + "X-Phyllite-Token: " + token.substr(1) + "x\r\n", with_token,
        "Host: phyllite.example\r\n" + with_token, "Host: " + other_port + "\r\n" + with_token,
        host() + "Host: phyllite.example\r\n" + with_token, known() + "Origin: http://phyllite.example\r\n",
        known() + "Origin: https://127.0.0.1:" + std::to_string(server.port()) + "\r\n",
        known() + "Origin: http://" + other_port + "\r\n", known() + "Origin: null\r\n"})
    EXPECT_EQ(get("/a", fields).status, 403) << fields;
  for (const char* method : {"OPTIONS", "PUT", "DELETE", "HEAD", "TRACE"})
    EXPECT_EQ(ask(server.port(), std::string(method) + " /a", known()).status, 405) << method;
  for (const char* target : {"/%zz", "/%0", "/%00", "a", "http://127.0.0.1/a"})
    EXPECT_EQ(get(target, known()).status, 400) << target;
  EXPECT_EQ(n_handled, 0);
}

/// Where an answer leads on to; "" where it is the answer.
std::string location_in(const Answer& answer) {
  const std::string mark = "\r\nLocation: ";
  const std::size_t begin = answer.head.find(mark);
  if (begin == answer.head.npos) return "";
  return answer.head.substr(begin + mark.size(), answer.head.find("\r\n", begin + 2) - begin - mark.size());
}

TEST_F(ServerTest, TheTokenOfFilesOpensFilesAlone) {
  EXPECT_EQ(get("/files/a?token=" + file_token, host()).status, 303);
  EXPECT_EQ(get("/?token=" + file_token, host()).status, 403);
  EXPECT_EQ(get("/api/files/a?token=" + file_token, host()).status, 403);
  EXPECT_EQ(ask(server.port(), "POST /files/a?token=" + file_token, host()).status, 403);
}

// A page can read its own address, and carry it to a server of somebody else.
TEST_F(ServerTest, AnAddressThatAPageSeesOpensThatPageAlone) {
  const std::string a = location_in(get("/files/a%20b.html?token=" + file_token, host()));
  ASSERT_THAT(a, testing::StartsWith("/files/a%20b.html?key="));
  EXPECT_THAT(a, AllOf(Not(HasSubstr(file_token)), Not(HasSubstr(token))));
  EXPECT_EQ(get(a, host()).body, "GET /files/a b.html ");  // the handler does not see the key
  EXPECT_EQ(get(a, host()).status, 200);                   // again, as when a page is loaded anew
  const std::string key = a.substr(a.find('?'));
  for (const char* other : {"/files/c.html", "/files/a%20b.htm", "/files/", "/", "/api/project"})
    EXPECT_EQ(get(other + key, host()).status, 403) << other;
  EXPECT_EQ(ask(server.port(), "POST " + a, host()).status, 403);
  const std::string c = location_in(get("/files/c.html?token=" + file_token, host()));
  EXPECT_NE(c.substr(c.find('?')), key);
  EXPECT_EQ(get("/files/d.html?key=", host()).status, 403);
  const std::string up = location_in(get("/files/../api?token=" + file_token, host()));
  EXPECT_EQ(get(up, host()).body, "GET /files/../api ");  // no way out of it
}

TEST_F(ServerTest, AFileIsSentWhole) {
  EXPECT_EQ(get("/file", known()).body, read(file));
  Wire wire(server.port());  // and the connection serves on
  ASSERT_TRUE(wire.send("GET /file HTTP/1.1\r\n" + known() +
                        "\r\nGET /two HTTP/1.1\r\nConnection: close\r\n" + known() + "\r\n"));
  EXPECT_THAT(wire.rest(), AllOf(HasSubstr("xend"), HasSubstr("GET /two")));
}

TEST_F(ServerTest, WhatIsNoRequestIsAnswered) {
  for (const std::string& fields :
       {std::string("Content-Length: -1\r\n"), std::string("Content-Length: 1\r\nContent-Length: 2\r\n"),
        std::string("X: a\0b\r\n", 8), std::string("no field\r\n")})
    EXPECT_EQ(ask(server.port(), "POST /a", known() + fields).status, 400) << fields;
  EXPECT_EQ(ask(server.port(), "GET /a b", known()).status, 400);
  Wire wire(server.port());
  wire.send("POST /a HTTP/1.1\r\n" + known() + "Transfer-Encoding: chunked\r\n\r\nzz\r\n");
  EXPECT_EQ(answer_in(wire.rest()).status, 400);
  EXPECT_EQ(get("/a", known() + "Origin: http://127.0.0.1\r\nOrigin: null\r\n").status, 403);
  const std::string mine = fmt::format("Origin: http://127.0.0.1:{}\r\n", server.port());
  EXPECT_EQ(get("/a", known() + mine + "Origin: http://phyllite.example\r\n").status, 403);
  EXPECT_EQ(n_handled, 0);
}

TEST_F(ServerTest, ItsEndIsNotKeptByAnAnswer) {
  Wire wire(server.port());
  wire.send("GET /slow HTTP/1.1\r\n" + known() + "\r\n");
  while (n_handled == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto start = std::chrono::steady_clock::now();
  stop = true;
  runs.join();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  EXPECT_FALSE(all_answered);
  released.set_value();
  runs = std::thread([] {});
}

TEST_F(ServerTest, ForbidsTheBrowserAllOthers) {
  const Answer own = get("/a", known()), foreign = get("/file", known());
  EXPECT_THAT(own.head, HasSubstr("default-src 'none'"));
  EXPECT_THAT(own.head, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(own.head, HasSubstr("no-referrer"));
  EXPECT_THAT(own.head, Not(HasSubstr("sandbox")));
  EXPECT_THAT(foreign.head, HasSubstr("sandbox allow-scripts"));  // a script there has another origin
  EXPECT_THAT(foreign.head, Not(HasSubstr("allow-same-origin")));
  EXPECT_THAT(foreign.head, Not(HasSubstr("connect-src")));
  EXPECT_THAT(own.head, Not(HasSubstr("Access-Control")));
}

TEST_F(ServerTest, RefusesAGigabyte) {
  EXPECT_EQ(ask(server.port(), "POST /a", known() + "Content-Length: 1073741824\r\n").status, 413);
  // the same in parts, which say no length before they end
  Wire wire(server.port());
  ASSERT_TRUE(wire.send("POST /a HTTP/1.1\r\n" + known() + "Transfer-Encoding: chunked\r\n\r\n"));
  const std::string part = "100000\r\n" + std::string(0x100000, 'x') + "\r\n";
  int n_sent = 0;
  while (n_sent < 1024 && wire.send(part)) ++n_sent;
  EXPECT_LT(n_sent, 64);
  EXPECT_EQ(get("/a", known() + "X-Long: " + std::string(100000, 'x') + "\r\n").status, 431);
  EXPECT_EQ(n_handled, 0);
}

TEST_F(ServerTest, AThousandConnectionsKeepNobodyOut) {
  rlimit files{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &files), 0);
  files.rlim_cur = files.rlim_max;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &files), 0);
  ASSERT_GT(files.rlim_cur, 400U);
  const int n = static_cast<int>(std::min<rlim_t>(1000, files.rlim_cur - 200));  // both ends are open here
  std::vector<Wire> idle;
  for (int i = 0; i < n; ++i) {
    idle.emplace_back(server.port());
    ASSERT_TRUE(idle.back().open()) << i;
    if (i % 2 == 0) idle.back().send("GET /a HTTP/1.1\r\nHost: ");  // and never the rest
  }
  EXPECT_EQ(get("/a", known()).status, 200);
}

TEST_F(ServerTest, OneSlowAnswerKeepsNobodyWaiting) {
  std::atomic<bool> answered{false};
  std::thread slow([&] {
    EXPECT_EQ(get("/slow", known()).status, 200);
    answered = true;
  });
  while (n_handled == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(get("/a", known()).status, 200);
  EXPECT_FALSE(answered);
  released.set_value();
  slow.join();
}

TEST_F(ServerTest, OneConnectionAsksSeveralTimes) {
  Wire wire(server.port());
  ASSERT_TRUE(wire.send("GET /one HTTP/1.1\r\n" + known() + "\r\nGET /two HTTP/1.1\r\nConnection: close\r\n" +
                        known() + "\r\n"));
  const std::string answers = wire.rest();
  EXPECT_THAT(answers, HasSubstr("GET /one"));
  EXPECT_THAT(answers, HasSubstr("GET /two"));
}

TEST_F(ServerTest, WhatAHandlerThrowsIsAnAnswer) {
  const Answer broken = get("/broken", known());
  EXPECT_EQ(broken.status, 500);
  EXPECT_EQ(broken.body, "a reason\n");
}

TEST_F(ServerTest, APortThatIsTakenIsSaid) {
  EXPECT_THROW(Server(static_cast<unsigned short>(server.port()), {token, file_token}, {}), IoError);
}

TEST(Token, IsLongAndAnotherEveryTime) {
  EXPECT_EQ(random_token().size(), 32U);
  EXPECT_NE(random_token(), random_token());
}

}  // namespace
}  // namespace phy::gui
