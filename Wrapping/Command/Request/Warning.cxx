#include "Warning.h"

namespace Command
{
namespace
{

std::function<void(const std::string&)>& Printer()
{
  static std::function<void(const std::string&)> printer;
  return printer;
}

} // namespace

void SendWarningsTo(const std::function<void(const std::string&)>& print)
{
  Printer() = print;
}

void Warn(const std::string& message)
{
  if (Printer())
  {
    Printer()(message);
  }
}

} // namespace Command
