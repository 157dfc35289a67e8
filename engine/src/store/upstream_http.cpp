#include "store/upstream_http.hpp"

#include <algorithm>
#include <cstring>

#include "ballflow/error.hpp"
#include "store/curl.hpp"

namespace ballflow {
namespace {

/// A server on the way is there or not; one that is there answers. A big blob takes its time as long as
/// something moves.
constexpr long connect_ms = 3000, quiet_seconds = 10, slowest_bytes_per_second = 1;

bool is_unreachable(CURLcode code) {
  return code == CURLE_COULDNT_CONNECT || code == CURLE_COULDNT_RESOLVE_HOST ||
         code == CURLE_COULDNT_RESOLVE_PROXY || code == CURLE_OPERATION_TIMEDOUT ||
         code == CURLE_GOT_NOTHING || code == CURLE_SEND_ERROR || code == CURLE_RECV_ERROR ||
         code == CURLE_SSL_CONNECT_ERROR;
}

struct Pieces {
  const std::vector<std::span<const std::byte>>& pieces;
  const std::function<bool()>& give_up;
  std::size_t piece = 0, at = 0;

  static std::size_t read(char* to, std::size_t size, std::size_t count, void* self_pointer) {
    auto& self = *static_cast<Pieces*>(self_pointer);
    if (self.give_up && self.give_up()) return CURL_READFUNC_ABORT;
    while (self.piece < self.pieces.size() && self.at == self.pieces[self.piece].size()) {
      ++self.piece;
      self.at = 0;
    }
    if (self.piece == self.pieces.size()) return 0;
    const std::span<const std::byte> left = self.pieces[self.piece].subspan(self.at);
    const std::size_t taken = std::min(left.size(), size * count);
    std::memcpy(to, left.data(), taken);
    self.at += taken;
    return taken;
  }
  /// A connection that was kept may turn out closed: then all is sent again.
  static int rewind(void* self_pointer, curl_off_t offset, int origin) {
    auto& self = *static_cast<Pieces*>(self_pointer);
    if (offset != 0 || origin != SEEK_SET) return CURL_SEEKFUNC_CANTSEEK;
    self.piece = self.at = 0;
    return CURL_SEEKFUNC_OK;
  }
};

struct Taker {
  const Upstream::Sink& sink;
  CURL* handle;
  bool refused = false;

  static std::size_t write(char* from, std::size_t size, std::size_t count, void* self_pointer) {
    auto& self = *static_cast<Taker*>(self_pointer);
    long status = 0;
    curl().easy_getinfo(self.handle, CURLINFO_RESPONSE_CODE, &status);
    if (status != 200) return size * count;  // the page that says what is wrong
    if (self.sink(std::as_bytes(std::span(from, size * count)))) return size * count;
    self.refused = true;
    return 0;
  }
};

std::size_t ignore(char*, std::size_t size, std::size_t count, void*) { return size * count; }

std::string http_status(long status) { return "the server answers with status " + std::to_string(status); }

}  // namespace

bool is_address(const std::string& place) {
  return place.starts_with("http://") || place.starts_with("https://");
}

/// One at a time; its socket stays open between requests.
class UpstreamHttp::Connection {
 public:
  Connection() : curl_(curl().easy_init()) {
    if (curl_ == nullptr) throw Error(ExitCode::store, "libcurl cannot be started");
    headers_ = curl().slist_append(nullptr, "Expect:");  // no pause before content is sent
    headers_ = curl().slist_append(headers_, "Content-Type: application/octet-stream");
  }
  ~Connection() {
    curl().slist_free_all(headers_);
    curl().easy_cleanup(curl_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  CURL* begin(const std::string& url) {
    curl().easy_reset(curl_);
    curl().easy_setopt(curl_, CURLOPT_URL, url.c_str());
    curl().easy_setopt(curl_, CURLOPT_NOSIGNAL, 1L);
    curl().easy_setopt(curl_, CURLOPT_CONNECTTIMEOUT_MS, connect_ms);
    curl().easy_setopt(curl_, CURLOPT_LOW_SPEED_TIME, quiet_seconds);
    curl().easy_setopt(curl_, CURLOPT_LOW_SPEED_LIMIT, slowest_bytes_per_second);
    curl().easy_setopt(curl_, CURLOPT_PROTOCOLS_STR, "http,https");
    curl().easy_setopt(curl_, CURLOPT_WRITEFUNCTION, &ignore);
    curl().easy_setopt(curl_, CURLOPT_HTTPHEADER, headers_);
    curl().easy_setopt(curl_, CURLOPT_BUFFERSIZE, 512L << 10);
    curl().easy_setopt(curl_, CURLOPT_ERRORBUFFER, error_);
    error_[0] = '\0';
    return curl_;
  }

  Answer send() {
    Answer answer;
    const CURLcode code = curl().easy_perform(curl_);
    curl().easy_getinfo(curl_, CURLINFO_RESPONSE_CODE, &answer.status);
    curl_off_t length = -1;
    curl().easy_getinfo(curl_, CURLINFO_CONTENT_LENGTH_DOWNLOAD_T, &length);
    answer.length = length < 0 ? 0 : static_cast<std::uint64_t>(length);
    if (code == CURLE_OK) return answer;
    answer.status = 0;
    answer.why = error_[0] != '\0' ? error_ : curl().easy_strerror(code);
    answer.unreachable = is_unreachable(code);
    return answer;
  }

 private:
  CURL* curl_;
  curl_slist* headers_ = nullptr;
  char error_[CURL_ERROR_SIZE] = {};
};

UpstreamHttp::UpstreamHttp(std::string address) : address_(std::move(address)) {
  while (address_.ends_with('/')) address_.pop_back();
  CURLU* const parts = curl().url();
  const bool good = curl().url_set(parts, CURLUPART_URL, address_.c_str(), 0) == CURLUE_OK;
  curl().url_cleanup(parts);
  if (good && address_.find_first_of("?#") == std::string::npos) return;
  throw Error(ExitCode::usage, "the upstream " + address_ + " is no address",
              "write it as http://host:port/path, or name a folder");
}

UpstreamHttp::~UpstreamHttp() = default;

std::unique_ptr<UpstreamHttp::Connection> UpstreamHttp::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<Connection> connection = std::move(idle_.back());
      idle_.pop_back();
      return connection;
    }
  }
  return std::make_unique<Connection>();
}

void UpstreamHttp::give_back(std::unique_ptr<Connection> connection) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(connection));
}

std::string UpstreamHttp::url(Room room, const Digest& name) const {
  return address_ + (room == Room::actions ? "/ac/" : "/cas/") + name.hex();
}

Upstream::Read UpstreamHttp::get(Room room, const Digest& name, const Sink& sink, bool) {
  std::unique_ptr<Connection> connection = take();
  CURL* const handle = connection->begin(url(room, name));
  Taker taker{sink, handle};
  curl().easy_setopt(handle, CURLOPT_WRITEFUNCTION, &Taker::write);
  curl().easy_setopt(handle, CURLOPT_WRITEDATA, &taker);
  const Answer answer = connection->send();
  give_back(std::move(connection));
  if (taker.refused) return {Got::refused, {}};
  if (answer.status == 200) return {Got::found, {}};
  if (answer.status == 404 || answer.status == 410) return {Got::absent, {}};
  if (answer.unreachable) return {Got::unreachable, answer.why};
  return {Got::failed, answer.status != 0 ? http_status(answer.status) : answer.why};
}

std::optional<std::uint64_t> UpstreamHttp::size(Room room, const Digest& name) {
  std::unique_ptr<Connection> connection = take();
  CURL* const handle = connection->begin(url(room, name));
  curl().easy_setopt(handle, CURLOPT_NOBODY, 1L);
  const Answer answer = connection->send();
  give_back(std::move(connection));
  if (answer.status != 200) return std::nullopt;
  return answer.length;
}

Upstream::Written UpstreamHttp::put(Room room, const Digest& name,
                                    const std::vector<std::span<const std::byte>>& pieces,
                                    const PutOptions& options) {
  if (!options.replace && size(room, name)) return {Put::there, {}};
  std::unique_ptr<Connection> connection = take();
  CURL* const handle = connection->begin(url(room, name));
  Pieces source{pieces, options.give_up};
  std::uint64_t bytes = 0;
  for (const std::span<const std::byte> piece : pieces) bytes += piece.size();
  curl().easy_setopt(handle, CURLOPT_UPLOAD, 1L);
  curl().easy_setopt(handle, CURLOPT_INFILESIZE_LARGE, static_cast<curl_off_t>(bytes));
  curl().easy_setopt(handle, CURLOPT_READFUNCTION, &Pieces::read);
  curl().easy_setopt(handle, CURLOPT_READDATA, &source);
  curl().easy_setopt(handle, CURLOPT_SEEKFUNCTION, &Pieces::rewind);
  curl().easy_setopt(handle, CURLOPT_SEEKDATA, &source);
  const Answer answer = connection->send();
  give_back(std::move(connection));
  if (answer.status >= 200 && answer.status < 300) return {Put::written, {}};
  if (answer.status != 0) return {Put::failed, http_status(answer.status)};
  if (options.give_up && options.give_up()) return {Put::given_up, {}};
  return {answer.unreachable ? Put::unreachable : Put::failed, answer.why};
}

bool UpstreamHttp::set_aside(Room room, const Digest& name) {
  std::unique_ptr<Connection> connection = take();
  CURL* const handle = connection->begin(url(room, name));
  curl().easy_setopt(handle, CURLOPT_CUSTOMREQUEST, "DELETE");
  const Answer answer = connection->send();
  give_back(std::move(connection));
  return answer.status >= 200 && answer.status < 300;
}

}  // namespace ballflow
