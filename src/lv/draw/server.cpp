#include "lv/draw/server.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/random.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <string_view>
#include <utility>

namespace lv::draw {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using net::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::seconds;

using Parser = http::request_parser<http::string_body>;
using Header = http::request<http::string_body>;
using Response = http::response<http::string_body>;

constexpr seconds silence{60};
constexpr std::uint32_t most_header = 16 << 10;

/// 128 random bits in hexadecimal digits.
std::string random_token() {
  std::array<unsigned char, 16> bits{};
  if (getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size()))
    throw RunError("the system gives no random numbers", "Try again");
  std::string token;
  for (const unsigned char byte : bits)
    token += fmt::format("{:02x}", byte);
  return token;
}

/// Equal or not in a time that does not tell how much is equal.
bool same_secret(std::string_view a, std::string_view b) {
  unsigned char differ = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    differ |= static_cast<unsigned char>(a[i] ^ b[i]);
  return differ == 0;
}

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

Answer words(unsigned status, const std::string& what) {
  return {status, "application/json",
          nlohmann::json{{"error", what}}.dump(-1, ' ', false,
                                               nlohmann::json::error_handler_t::replace)};
}

Response response_of(Answer answer, unsigned version, bool keep) {
  Response response{static_cast<http::status>(answer.status), version};
  response.set(http::field::content_type, answer.type);
  response.set(http::field::cache_control, "no-store");
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
               "img-src data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
               "frame-ancestors 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("X-Frame-Options", "DENY");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.keep_alive(keep);
  response.body() = std::move(answer.body);
  response.prepare_payload();
  return response;
}

/// What requests must say.
struct Rules {
  std::string token;
  std::string host;  ///< 127.0.0.1:PORT

  [[nodiscard]] Answer refusal(const Header& request) const;
  [[nodiscard]] std::string place(std::string_view target) const;

 private:
  [[nodiscard]] bool of_this_origin(const Header& request, bool opens_page) const;
};

/// What follows "/TOKEN/".
std::string Rules::place(std::string_view target) const {
  return std::string(target.substr(token.size() + 2));
}

bool Rules::of_this_origin(const Header& request, bool opens_page) const {
  if (view(request[http::field::host]) != host)
    return false;
  const auto origin = request.find(http::field::origin);
  if (origin != request.end() && view(origin->value()) != "http://" + host)
    return false;
  if (origin == request.end() && request.method() != http::verb::get)
    return false;
  const auto site = view(request["Sec-Fetch-Site"]);
  return site.empty() || site == "same-origin" || site == "none" ||
         (opens_page && view(request["Sec-Fetch-Mode"]) == "navigate" &&
          view(request["Sec-Fetch-Dest"]) == "document");
}

/// Status 200 where there is nothing to refuse.
Answer Rules::refusal(const Header& request) const {
  const std::string_view target = view(request.target());
  if (request.method() != http::verb::get && request.method() != http::verb::post)
    return words(405, "only GET and POST are answered");
  for (const char* never : {"..", "%", "\\", "//"})
    if (target.find(never) != std::string_view::npos)
      return words(400, "there is no such address");
  const auto end = target.find('/', 1);
  if (!target.starts_with('/') || end == std::string_view::npos ||
      !same_secret(target.substr(1, end - 1), token))
    return words(403, "the address lacks its token: open the one that ventricle draw prints");
  if (!of_this_origin(request, end + 1 == target.size()))
    return words(403, "only the page that ventricle draw serves may ask this");
  return {};
}

Answer handled(const Handler& handler, const Request& request) {
  try {
    return handler(request);
  } catch (const InputError& error) {
    return words(400, error.what());
  } catch (const RunError& error) {
    return words(500, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return words(500,
                 fmt::format("{}: {}", error.path1().filename().string(), error.code().message()));
  } catch (const Interrupted&) {
    return words(503, "ventricle draw is ending");
  }
}

/// Completes a step of a connection with an error noted instead of thrown.
auto noting(beast::error_code& error) {
  return net::redirect_error(net::use_awaitable, error);
}

/// One connection: its requests one after the other.
class Connection {
 public:
  Connection(tcp::socket socket, const Rules& rules, const Handler& handler)
      : stream_(std::move(socket)), rules_(rules), handler_(handler) {}

  net::awaitable<void> serve() {
    while (co_await answer_one())
      ;
    beast::error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    co_await drain();
  }

 private:
  /// Whether another request may follow.
  net::awaitable<bool> answer_one() {
    Parser parser;
    parser.body_limit(most_body);
    parser.header_limit(most_header);
    beast::error_code error;
    stream_.expires_after(silence);
    co_await http::async_read_header(stream_, buffer_, parser, noting(error));
    if (error && error != http::error::body_limit)
      co_return false;
    Answer answer = error ? words(413, fmt::format("more than {} MB", most_body >> 20))
                          : rules_.refusal(parser.get());
    if (answer.status == 200) {
      if (view(parser.get()[http::field::expect]) == "100-continue")
        co_await go_on(parser.get().version());
      co_await http::async_read(stream_, buffer_, parser, noting(error));
      if (error && error != http::error::body_limit)
        co_return false;
      answer = error ? words(413, fmt::format("more than {} MB", most_body >> 20))
                     : handled(handler_, asked(parser.get()));
    }
    const bool keep = parser.get().keep_alive() && parser.is_done();
    const Response response = response_of(std::move(answer), parser.get().version(), keep);
    stream_.expires_after(silence);
    co_await http::async_write(stream_, response, noting(error));
    co_return !error && keep;
  }

  net::awaitable<void> go_on(unsigned version) {
    const http::response<http::empty_body> response{http::status::continue_, version};
    beast::error_code error;
    co_await http::async_write(stream_, response, noting(error));
  }

  /// Reads what a refused sender still sends, for a while: else it would not see the answer.
  net::awaitable<void> drain() {
    std::array<char, 1 << 14> nothing;
    beast::error_code error;
    stream_.expires_after(seconds(2));
    while (!error)
      co_await stream_.async_read_some(net::buffer(nothing), noting(error));
  }

  [[nodiscard]] Request asked(const Header& request) const {
    return {std::string(view(request.method_string())), rules_.place(view(request.target())),
            request.body()};
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  const Rules& rules_;
  const Handler& handler_;
};

}  // namespace

struct Server::State {
  explicit State(Handler h) : handler(std::move(h)) {}

  net::io_context context{1};
  tcp::acceptor acceptor{context};
  Handler handler;
  Rules rules;
  std::string address;

  void listen() {
    const tcp::endpoint here(net::ip::address_v4::loopback(), 0);
    acceptor.open(here.protocol());
    acceptor.bind(here);
    acceptor.listen();
    rules = {random_token(), fmt::format("127.0.0.1:{}", acceptor.local_endpoint().port())};
    address = fmt::format("http://{}/{}/", rules.host, rules.token);
  }

  net::awaitable<void> accept() {
    for (;;) {
      beast::error_code error;
      tcp::socket socket = co_await acceptor.async_accept(noting(error));
      if (!error)
        net::co_spawn(context, serve(std::move(socket)), net::detached);
    }
  }

  net::awaitable<void> serve(tcp::socket socket) {
    Connection connection(std::move(socket), rules, handler);
    co_await connection.serve();
  }

  /// A signal only leaves a note: it is looked for ten times a second.
  net::awaitable<void> watch() {
    net::steady_timer timer(context);
    while (!interrupt::requested()) {
      timer.expires_after(milliseconds(100));
      co_await timer.async_wait(net::use_awaitable);
    }
    context.stop();
  }
};

Server::Server(Handler handler) : state_(std::make_unique<State>(std::move(handler))) {
  try {
    state_->listen();
  } catch (const boost::system::system_error& error) {
    throw RunError(
        fmt::format("nothing can listen on 127.0.0.1: {}", error.code().message()),
        "Look whether the system forbids it; --export makes a page that needs no server");
  }
}

Server::~Server() = default;

const std::string& Server::address() const {
  return state_->address;
}

void Server::run() {
  net::co_spawn(state_->context, state_->accept(), net::detached);
  net::co_spawn(state_->context, state_->watch(), net::detached);
  state_->context.run();
}

}  // namespace lv::draw
