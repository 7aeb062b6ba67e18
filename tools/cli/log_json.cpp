#include "cli/log_json.hpp"

#include "json/json.hpp"

namespace firmtouch::cli {

using tools::Json;
using tools::json_list;

std::string json_of(const log::Statistics& s) {
  Json period;
  period.add("count", s.period.count).add("median_us", s.period.median_us);
  period.add("mean_us", s.period.mean_us).add("deviation_us", s.period.deviation_us);
  period.add("least_us", s.period.min_us).add("p99_us", s.period.p99_us);
  period.add("p999_us", s.period.p999_us).add("most_us", s.period.max_us);
  period.add("most_number", s.period.max_number);
  Json all;
  all.add("records", s.records).add("blocks", s.blocks).add("missing", s.missing);
  all.add("first_number", s.first_number).add("last_number", s.last_number);
  all.add("seconds", s.seconds).add("troubles", tools::json_text(s.troubles));
  all.add("gaps", json_list(s.gaps, [](const log::Gap& gap) {
            return Json()
                .add("number", gap.number)
                .add("count", gap.count)
                .add("of_blocks", gap.of_blocks)
                .object();
          }));
  all.add("period", period.object()).add("mean_steps", s.mean_steps);
  all.add("worst_steps", json_list(s.worst_steps, [](const log::Statistics::Steps& at) {
            return Json().add("number", at.number).add("steps", uint64_t{at.steps}).object();
          }));
  if (s.not_finite.records > 0)
    all.add("not_finite", Json()
                              .add("records", s.not_finite.records)
                              .add("first_number", s.not_finite.first_number)
                              .add("first_field", tools::json_text(s.not_finite.first_field))
                              .object());
  all.add("most_force_N", s.max_force_N).add("most_force_number", s.max_force_number);
  all.add("faults", json_list(s.faults, [](const log::Statistics::Fault& fault) {
            return Json()
                .add("what", tools::json_text(fault.what))
                .add("first_number", fault.first_number)
                .add("records", fault.records)
                .object();
          }));
  return all.object() + "\n";
}

// What a log says of itself, its fields and their bits.
std::string json_of(const log::Reader& reader) {
  constexpr const char* kTypes[] = {"u32", "i32", "f32"};
  const log::Header& header = reader.header();
  Json text, all;
  for (const auto& [key, value] : header.text)
    text.add(log::printable(key), tools::json_text(value));
  all.add("records", reader.records()).add("blocks", uint64_t{reader.blocks()});
  all.add("missing", reader.missing()).add("decimation", uint64_t{header.decimation});
  all.add("record_bytes", uint64_t{header.record_bytes});
  all.add("troubles", tools::json_text(reader.troubles()));
  all.add("fields", json_list(header.fields, [&](const log::Field& field) {
            return Json()
                .add("name", tools::json_text(field.name))
                .add("unit", tools::json_text(field.unit))
                .add("type", tools::json_text(kTypes[static_cast<size_t>(field.type)]))
                .add("count", uint64_t{field.count})
                .add("scale", field.scale)
                .add("zero", field.zero)
                .object();
          }));
  all.add("bits", json_list(header.bits, [](const log::Bit& bit) {
            return Json()
                .add("field", tools::json_text(bit.field))
                .add("bit", uint64_t{bit.bit})
                .add("name", tools::json_text(bit.what))
                .object();
          }));
  return all.add("text", text.object()).object() + "\n";
}

}  // namespace firmtouch::cli
