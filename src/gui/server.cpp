#include "gui/server.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <condition_variable>
#include <list>
#include <mutex>
#include <optional>
#include <utility>

#include "base/check.hpp"
#include "system/files.hpp"
#include "system/process.hpp"

namespace phy::gui {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using net::ip::tcp;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds patience{20};  // for a request, and for a connection without one
constexpr std::size_t largest_header = 16 << 10;
// A check takes a second on large tables, and must not hold up the clock of another tab.
constexpr int n_answering = 4;
constexpr std::chrono::milliseconds patience_at_end{500};

/// Nothing from anywhere else, and no other page around this one.
constexpr const char* own_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
    "connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors 'none'";
/// The same for files of the folder, whose scripts are nobody's to trust with the token: an origin of its
/// own.
constexpr const char* foreign_policy =
    "sandbox allow-scripts allow-downloads allow-modals; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data: blob:; form-action 'none'; base-uri 'none'; "
    "frame-ancestors 'none'";

/// Takes as long whatever the difference.
bool same(const std::string& a, const std::string& b) {
  // The length is no secret.
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return difference == 0;
}

Response refused(int status, const std::string& why) {
  return {status, "text/plain; charset=utf-8", why + "\n"};
}

/// What cannot be read as a request; nothing: the other side has gone, or fallen silent.
std::optional<Response> refusal_of(beast::error_code error) {
  static const auto& of_http = make_error_code(http::error::bad_method).category();
  if (error == http::error::body_limit) return refused(413, "too much at once");
  if (error == http::error::header_limit) return refused(431, "the head of the request is too long");
  if (error.category() != of_http || error == http::error::end_of_stream ||
      error == http::error::partial_message)
    return {};
  return refused(400, "this is no request of HTTP 1.1");
}

/// What a target says: path and query. Nothing: it cannot be read.
std::optional<Request> request_of(const std::string& target) {
  Request request;
  const std::size_t mark = target.find('?');
  if (!decode_url(target.substr(0, mark), false, request.path) || !request.path.starts_with('/')) return {};
  std::string rest = mark == target.npos ? "" : target.substr(mark + 1);
  while (!rest.empty()) {
    const std::size_t end = rest.find('&');
    const std::string pair = rest.substr(0, end);
    rest = end == rest.npos ? "" : rest.substr(end + 1);
    const std::size_t equals = pair.find('=');
    std::string key, value;
    if (!decode_url(pair.substr(0, equals), true, key)) return {};
    if (equals != pair.npos && !decode_url(pair.substr(equals + 1), true, value)) return {};
    request.query[key] = value;
  }
  return request;
}

}  // namespace

bool decode_url(const std::string& text, bool plus_is_blank, std::string& decoded) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  decoded.clear();
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += plus_is_blank && text[i] == '+' ? ' ' : text[i];
      continue;
    }
    if (i + 2 >= text.size()) return false;
    const int high = digit(text[i + 1]), low = digit(text[i + 2]);
    // A NUL would end the name of a file early, after it was checked as a whole.
    if (high < 0 || low < 0 || 16 * high + low == 0) return false;
    decoded += static_cast<char>(16 * high + low);
    i += 2;
  }
  return true;
}

std::string random_token() {
  unsigned char bytes[16];
  if (!system::random_bytes(bytes, sizeof bytes)) throw IoError("the system gives no random numbers");
  std::string token;
  for (const unsigned char b : bytes) token += fmt::format("{:02x}", b);
  return token;
}

class Server::Impl {
 public:
  Impl(unsigned short port, Tokens tokens, Handler handler)
      : tokens_(std::move(tokens)),
        handler_(std::move(handler)),
        acceptor_(context_),
        watch_(context_),
        pause_(context_) {
    try {
      // Never any other address: whoever reaches the page can write files.
      const tcp::endpoint here(net::ip::address_v4::loopback(), port);
      acceptor_.open(here.protocol());
      acceptor_.set_option(net::socket_base::reuse_address(system::ports_linger()));
      acceptor_.bind(here);
      acceptor_.listen();
      // With port 0 the system has chosen one.
      port_ = acceptor_.local_endpoint().port();
    } catch (const boost::system::system_error& e) {
      throw IoError(fmt::format("127.0.0.1:{}: {}; choose another --port, or 0 for one that is free", port,
                                e.code().message()));
    }
  }

  int port() const { return port_; }
  std::string address() const { return fmt::format("http://127.0.0.1:{}/?token={}", port_, tokens_.all); }

  bool run(const std::atomic<bool>& stop) {
    look(stop);
    accept();
    context_.run();
    std::unique_lock lock(mutex_);
    return answered_.wait_for(lock, patience_at_end, [&] { return n_answering_ == 0; });
  }

 private:
  class Connection;
  using Connections = std::list<std::shared_ptr<Connection>>;

  void look(const std::atomic<bool>& stop) {
    // A signal handler may only set a flag, so that somebody has to look.
    if (stop) return context_.stop();
    watch_.expires_after(std::chrono::milliseconds(200));
    watch_.async_wait([this, &stop](const boost::system::error_code&) { look(stop); });
  }
  /// Makes an answer on another thread.
  template <class Answer>
  void answer_later(Answer answer) {
    change_answering(1);
    net::post(pool_, [this, answer = std::move(answer)] {
      answer();
      change_answering(-1);
    });
  }
  void change_answering(int by) {
    const std::lock_guard lock(mutex_);
    n_answering_ += by;
    answered_.notify_all();
  }
  /// To the address with the key of a file, which is made when it is first asked for.
  Response to_key_of(const Request& request, const std::string& target);
  void accept();
  void accept_later();
  void make_room();
  /// Nothing: it may come in.
  std::optional<Response> refusal(const http::request<http::string_body>& head, Request& request);

  Tokens tokens_;
  Handler handler_;
  // Connections live on one thread and need no locks; answers are made on the pool.
  net::io_context context_{1};
  std::mutex mutex_;
  std::condition_variable answered_;
  int n_answering_ = 0;
  // Behind what answers use: members end in reverse, and the pool waits for its threads.
  net::thread_pool pool_{n_answering};
  tcp::acceptor acceptor_;
  net::steady_timer watch_, pause_;
  int port_ = 0;
  Connections connections_;
  std::map<std::string, std::string> keys_;  // of files, by path
};

/// Of one browser or program: requests one after the other. Lives as long as something is under way.
class Server::Impl::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Impl& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {}

  void begin(Connections::iterator place) {
    place_ = place;
    read_head();
  }
  bool waits() const { return waits_; }
  Clock::time_point since() const { return since_; }
  void close() { stream_.close(); }

 private:
  Impl& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
  http::response<http::basic_file_body<beast::file_stdio>> file_response_;
  Connections::iterator place_;
  bool waits_ = true;
  Clock::time_point since_ = Clock::now();

  void leave() {
    stream_.close();
    server_.connections_.erase(place_);
  }
  void read_head() {
    parser_.emplace();
    parser_->body_limit(largest_body);
    parser_->header_limit(static_cast<std::uint32_t>(largest_header));
    waits_ = true, since_ = Clock::now();
    stream_.expires_after(patience);
    // The head first: who has no token should not be able to send 16 MB.
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = this->shared_from_this()](beast::error_code error, std::size_t) { self->on_head(error); });
  }
  void on_head(beast::error_code error) {
    if (auto no = refusal_of(error)) return refuse(std::move(*no));
    if (error) return leave();
    Request request;
    if (auto no = server_.refusal(parser_->get(), request)) return refuse(std::move(*no));
    stream_.expires_after(patience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this(), request = std::move(request)](
                         beast::error_code e, std::size_t) mutable { self->on_body(e, std::move(request)); });
  }
  void on_body(beast::error_code error, Request request) {
    if (auto no = refusal_of(error)) return refuse(std::move(*no));
    if (error) return leave();
    request.body = std::move(parser_->get().body());
    waits_ = false;
    // The answer may take longer than patience with a silent browser.
    stream_.expires_never();
    server_.answer_later([self = this->shared_from_this(), request = std::move(request)] {
      Response response;
      try {
        response = self->server_.handler_(request);
      } catch (const std::exception& e) {
        response = refused(500, e.what());
      }
      // Back on the thread of the connections, to which the stream belongs.
      net::post(self->server_.context_, [self, response = std::move(response)]() mutable {
        self->answer(std::move(response), self->parser_->get().keep_alive());
      });
    });
  }
  /// What has not been read of the request is in the way of another one.
  void refuse(Response response) { answer(std::move(response), false); }

  void answer(Response response, bool keep) {
    waits_ = false;
    response_ = {}, file_response_ = {};
    if (!response.file) {
      response_.body() = std::move(response.body);
      return send(response_, response, keep);
    }
    beast::error_code error;
    beast::file_stdio file;
    file.native_handle(system::as_stream(response.file->release()));
    file_response_.body().reset(std::move(file), error);
    if (error) return leave();
    send(file_response_, response, keep);
  }

  template <class Message>
  void send(Message& message, const Response& response, bool keep) {
    message.result(static_cast<unsigned>(response.status));
    message.version(11);
    message.keep_alive(keep);
    message.set(http::field::content_type, response.type);
    // Files change under the same address, and a token should not lie in a cache.
    message.set(http::field::cache_control, "no-store");
    // Else a browser may run a text file as a script.
    message.set("X-Content-Type-Options", "nosniff");
    // The address holds the token.
    message.set("Referrer-Policy", "no-referrer");
    message.set("Cross-Origin-Resource-Policy", "same-origin");
    message.set("Cross-Origin-Opener-Policy", "same-origin");
    message.set("Content-Security-Policy", response.foreign() ? foreign_policy : own_policy);
    if (!response.location.empty()) message.set(http::field::location, response.location);
    message.prepare_payload();
    stream_.expires_after(patience);
    http::async_write(stream_, message,
                      [self = this->shared_from_this(), keep](beast::error_code error, std::size_t) {
                        if (error || !keep) return self->leave();
                        self->read_head();
                      });
  }
};

void Server::Impl::accept() {
  acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error) return accept_later();
    make_room();
    connections_.push_back(std::make_shared<Connection>(*this, std::move(socket)));
    connections_.back()->begin(std::prev(connections_.end()));
    accept();
  });
}

/// Without a free descriptor it would fail again at once.
void Server::Impl::accept_later() {
  pause_.expires_after(std::chrono::milliseconds(200));
  pause_.async_wait([this](const boost::system::error_code&) { accept(); });
}

/// Closes the connection that has waited longest for its user. All of them at work: there are no more of
/// these than requests that the user has made.
void Server::Impl::make_room() {
  if (connections_.size() < most_connections) return;
  Connection* longest = nullptr;
  for (const auto& c : connections_)
    if (c->waits() && (longest == nullptr || c->since() < longest->since())) longest = c.get();
  if (longest != nullptr) longest->close();
}

std::optional<Response> Server::Impl::refusal(const http::request<http::string_body>& head,
                                              Request& request) {
  const auto text = [&](http::field name) { return std::string(head[name]); };
  const auto is_here = [&](const std::string& place) {
    const std::string port = port_ == 80 ? "" : fmt::format(":{}", port_);  // 80 is left out
    return place == "127.0.0.1" + port || place == "localhost" + port;
  };
  // A page elsewhere may let its own name point to 127.0.0.1; only the Host header tells.
  if (head.count(http::field::host) != 1 || !is_here(text(http::field::host)))
    return refused(403, "this is no host that Phyllite serves");
  if (head.count(http::field::origin) > 1) return refused(403, "a request comes from one page");
  // Programs such as curl send none; the token alone decides about them.
  if (head.count(http::field::origin) > 0) {
    const std::string origin = text(http::field::origin);
    if (!origin.starts_with("http://") || !is_here(origin.substr(7)))
      return refused(403, "a page of another site asks");
  }
  if (head.method() != http::verb::get && head.method() != http::verb::post)
    return refused(405, "GET and POST alone are served");
  auto read = request_of(std::string(head.target()));
  if (!read) return refused(400, "no address of this server");
  const std::string token =
      // In a header where the page asks by script, in the address where a browser opens it.
      head.count("X-Phyllite-Token") > 0 ? std::string(head["X-Phyllite-Token"]) : read->query["token"];
  const bool of_file = head.method() == http::verb::get && read->path.starts_with("/files/");
  if (of_file && same(token, tokens_.file)) return to_key_of(*read, std::string(head.target()));
  const auto key = keys_.find(read->path);
  const bool has_key = of_file && key != keys_.end() && same(read->query["key"], key->second);
  if (!same(token, tokens_.all) && !has_key)
    return refused(403,
                   "the token is missing or of another start: open the address that `phyllite gui` prints");
  request = std::move(*read);
  // No answer can repeat what it does not know.
  request.query.erase("token"), request.query.erase("key");
  request.method = std::string(head.method_string());
  return {};
}

Response Server::Impl::to_key_of(const Request& request, const std::string& target) {
  std::string& key = keys_[request.path];
  if (key.empty()) key = random_token();
  Response response{303, "text/plain; charset=utf-8", ""};
  response.location = target.substr(0, target.find('?')) + "?key=" + key;
  return response;
}

Server::Server(unsigned short port, Tokens tokens, Handler handler)
    : impl_(std::make_unique<Impl>(port, std::move(tokens), std::move(handler))) {}
Server::~Server() = default;
int Server::port() const { return impl_->port(); }
std::string Server::address() const { return impl_->address(); }
bool Server::run(const std::atomic<bool>& stop) { return impl_->run(stop); }

}  // namespace phy::gui
