#include "runs/live/web_server.h"

#include "runs/live/server_seam.h"
#include "scenes/errors.h"
#include "image/module_file.h"

#include <fmt/format.h>

namespace meninas {

namespace {

const web::Table& server_table() {
  const ModuleName name{"meninas_server.so", web::entry_point, "serves pages"};
  const OpenModule module = open_module(name);
  const auto entry = reinterpret_cast<web::EntryPoint>(module.entry);
  const web::Table* table = entry == nullptr ? nullptr : entry();
  if (table == nullptr || table->seam_version != web::seam_version)
    refuse_module(name, module);
  return *table;
}

} // namespace

WebServer::WebServer(int port, AnswerRequest answer, NextEvent events) : table_(&server_table()) {
  server_ = table_->open(port, {std::move(answer), std::move(events)}, place_);
  if (server_ == nullptr)
    throw OutputError("", fmt::format("127.0.0.1:{}", port), place_.problem);
}

WebServer::~WebServer() { table_->close(server_); }

int WebServer::port() const { return place_.port; }

std::string WebServer::address() const {
  return fmt::format("http://127.0.0.1:{}/{}/", place_.port, place_.token);
}

} // namespace meninas
