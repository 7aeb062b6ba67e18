#include "log/drain.hpp"

#include <algorithm>

namespace firmtouch::log {

Drain::Drain(Records& records, Header header, DrainOptions options, Make make, Remove remove)
    : records_(records),
      header_(std::move(header)),
      options_(options),
      make_(std::move(make)),
      remove_(std::move(remove)) {
  header_.record_bytes = place(header_.fields);
}

bool Drain::failed(double now_s, const std::string& problem) {
  ++totals_.failures;
  totals_.problem = problem;
  retry_at_s_ = now_s + options_.retry_s;
  return false;
}

bool Drain::open_part() {
  if (!sink_) {
    sink_ = make_(totals_.files, totals_.problem);
    if (!sink_) return false;
    Header header = header_;
    if (options_.file_bytes > 0) header.text["part"] = std::to_string(totals_.files + 1);
    writer_ = std::make_unique<Writer>(*sink_, header);
    reserved_ = 0;
    ++totals_.files;
    if (options_.keep_files > 0 && totals_.files > options_.keep_files)
      remove_(totals_.files - 1 - options_.keep_files);
  }
  if (writer_->has_begun()) return true;
  if (writer_->begin()) return true;
  totals_.problem = sink_->problem();
  return false;
}

void Drain::rotate() {
  writer_->finish();
  sink_->sync();
  records_of_closed_ += writer_->records();
  missing_of_closed_ += writer_->missing();
  bytes_of_closed_ += writer_->bytes();
  writer_.reset();
  sink_.reset();
}

// One block. Result: false where there is nothing to write or the disk refuses.
bool Drain::write_some(double now_s) {
  const core::Bytes ready = records_.ready();
  const uint32_t count = std::min(ready.size() / header_.record_bytes, options_.block_records);
  if (count == 0) return false;
  if (!open_part()) return failed(now_s, totals_.problem);
  if (writer_->bytes() + options_.reserve_bytes / 2 > reserved_ && options_.reserve_bytes > 0)
    sink_->reserve(reserved_ = writer_->bytes() + options_.reserve_bytes);
  const uint32_t first = word(ready.data(), 0);
  // What was lost between two files belongs to neither's blocks.
  const uint64_t between = writer_->records() == 0 && has_number_
                               ? missing_between(0, first - next_number_, header_.decimation)
                               : 0;
  const uint32_t last = word(ready.data(), (count - 1) * header_.record_bytes);
  if (!writer_->append(ready.data(), count)) return failed(now_s, sink_->problem());
  missing_of_closed_ += between;
  next_number_ = last + header_.decimation;
  has_number_ = true;
  records_.release(count);
  last_write_s_ = now_s;
  is_dirty_ = true;
  totals_.records = records_of_closed_ + writer_->records();
  totals_.missing = missing_of_closed_ + writer_->missing();
  totals_.bytes = bytes_of_closed_ + writer_->bytes();
  if (options_.file_bytes > 0 && writer_->bytes() >= options_.file_bytes) rotate();
  return true;
}

bool Drain::step(double now_s) {
  const uint32_t waiting = records_.waiting();
  totals_.max_waiting = std::max(totals_.max_waiting, waiting);
  if (now_s < retry_at_s_) return false;
  const bool is_due =
      waiting >= options_.block_records || now_s - last_write_s_ >= options_.flush_s;
  bool wrote = false;
  if (is_due && waiting > 0) wrote = write_some(now_s);
  if (is_dirty_ && sink_ && now_s - last_sync_s_ >= options_.sync_s) {
    last_sync_s_ = now_s;
    is_dirty_ = false;
    if (!sink_->sync()) failed(now_s, sink_->problem());
  }
  return wrote && records_.waiting() >= options_.block_records;
}

bool Drain::finish() {
  const double now_s = last_write_s_ + options_.flush_s;
  const uint32_t failures = totals_.failures;
  while (write_some(now_s)) {
  }
  if (!writer_ && has_number_ && records_.ready().empty()) return true;  // rotated just now
  if (totals_.failures != failures) return false;
  if (!open_part()) return failed(now_s, totals_.problem);
  const uint32_t behind = records_.produced() - next_number_;
  const uint64_t produced =
      has_number_ && behind < UINT32_MAX / 2 ? writer_->next_number() + behind : 0;
  if (!writer_->finish(produced)) return failed(now_s, sink_->problem());
  totals_.missing = missing_of_closed_ + writer_->missing();
  if (!sink_->sync()) return failed(now_s, sink_->problem());
  return true;
}

}  // namespace firmtouch::log
