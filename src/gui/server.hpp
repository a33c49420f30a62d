// An HTTP server for one user on one machine: what `phyllite gui` is reached by. It knows nothing of rock.
//
// It listens on 127.0.0.1 alone. Programs of the same machine, and pages of other sites that the user's
// browser shows, can reach that address, too. So every request must name this very server (Host), must not
// come from a page of another origin, and must carry the token that was printed when the server began; all
// of that is looked at before the body is read. What is served forbids the browser every request to anywhere
// else.
//
// One thread reads and writes all connections, of which there are few at a time: a further one takes the
// place of the one that has waited longest. Answers are made on threads of their own.
#pragma once
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "io/file.hpp"

namespace phy::gui {

struct Request {
  std::string method;                        ///< "GET", "POST"
  std::string path;                          ///< decoded, without the query
  std::map<std::string, std::string> query;  ///< decoded, without the token
  std::string body;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::shared_ptr<io::InputFile> file = {};  ///< sent in place of the body, piece by piece, and as `foreign`
  std::string location = {};                 ///< where the browser is to look instead

  /// A page that may run its scripts, but not as a page of this server.
  bool foreign() const { return file != nullptr; }
};

/// Called from several threads at once. What it throws is answered with status 500.
using Handler = std::function<Response(const Request&)>;

/// `file` asks for what lies under /files/ and for nothing else. The answer leads on to an address with the
/// key of that one file: a page whose scripts are nobody's to trust sees its own address, and can carry it
/// away.
struct Tokens {
  std::string all, file;
};

constexpr std::size_t most_connections = 64, largest_body = 16 << 20;

class Server {
 public:
  /// Listens at once. `port` 0: one that is free. Throws IoError.
  Server(unsigned short port, Tokens tokens, Handler handler);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  int port() const;
  /// For the browser, with the token.
  std::string address() const;
  /// Until `stop` is true, and half a second longer for answers that are being made. False: some are not
  /// done, and the end of this object would wait for them.
  bool run(const std::atomic<bool>& stop);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// 128 bits from the system's source of randomness, in hexadecimal digits. Throws IoError.
std::string random_token();

/// "%20" and "+" of a query; false: no text of this kind.
bool decode_url(const std::string& text, bool plus_is_blank, std::string& decoded);

}  // namespace phy::gui
