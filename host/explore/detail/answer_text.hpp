// The body of an answer.
#pragma once

#include <httplib.h>

#include <cstddef>
#include <memory>
#include <string>

namespace gearsweep {

// As it is: httplib's set_content() would have a browser's answers compressed, which takes seconds
// for a motion and saves nothing on this machine's own address.
inline void answer_text(std::string text, const char* type, httplib::Response* response) {
  const auto shared = std::make_shared<const std::string>(std::move(text));
  response->set_content_provider(
      shared->size(), type,
      [shared](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(shared->data() + offset, length);
      });
}

}  // namespace gearsweep
