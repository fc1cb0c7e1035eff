#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

/// A server for one page on this machine.
namespace lv::draw {

struct Request {
  std::string method;  ///< GET or POST
  std::string place;   ///< what follows the token in the address, "" for the page itself
  std::string body;
};

struct Answer {
  unsigned status = 200;
  std::string type = "application/json";
  std::string body;
};

using Handler = std::function<Answer(const Request&)>;

/// The largest body that is read [bytes].
inline constexpr std::uint64_t most_body = std::uint64_t{16} << 20;

/// Listens on 127.0.0.1, at a port that is free, and answers requests whose address holds a token
/// of 128 random bits. Refused, before a handler sees them, are
///
///   403  a request without the token, with another Host than this one (a name that was made to
///        point here), from a page of another origin (Origin, Sec-Fetch-Site), or one that changes
///        something and does not say its origin
///   400  an address with "..", "%", "\" or "//", which no page of ours asks for
///   405  other methods than GET and POST
///   413  a body of more than most_body, before it is read
///
/// and a connection that says nothing for a minute is closed.
class Server {
 public:
  /// Throws RunError if nothing can listen here.
  explicit Server(Handler handler);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// http://127.0.0.1:PORT/TOKEN/
  [[nodiscard]] const std::string& address() const;

  /// Answers, one request after the other, until this process is asked to stop (lv::interrupt).
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lv::draw
