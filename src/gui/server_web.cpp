// In a browser no server stands between the page and the program: the page's worker calls `phyllite_answer`
// (packaging/browser/worker.js).
#include "base/check.hpp"
#include "gui/api.hpp"
#include "io/json.hpp"

namespace phy::gui {

class Server::Impl {};

Server::Server(unsigned short, Tokens, Handler) {
  throw IoError("A browser has no server. The page is open already.");
}
Server::~Server() = default;
int Server::port() const { return 0; }
std::string Server::address() const { return ""; }
bool Server::run(const std::atomic<bool>&) { return true; }

std::string random_token() { return "none"; }  // there is nobody else to keep out

}  // namespace phy::gui

/// Four words of 32 bits, which stay until the next call.
struct Given {
  const char* body;
  std::size_t length;
  int status;
  const char* type;
};

/// `head`: method, path and query as JSON.
extern "C" const Given* phyllite_answer(const char* head, const char* body, std::size_t n) {
  using namespace phy;
  static gui::Api api(0, gui::random_token());
  static gui::Response answer;
  static Given given;
  const auto asked = io::parse_json<gui::Json>(head);
  answer = api.answer({asked.at("method"), asked.at("path"), asked.at("query"), {body, n}});
  if (answer.file) answer.body = answer.file->read(0, answer.file->size());
  answer.file = nullptr;
  given = {answer.body.data(), answer.body.size(), answer.status, answer.type.c_str()};
  return &given;
}
