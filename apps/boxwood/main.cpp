// boxwood: builds, traces, compares and checks ray tracing acceleration structures from the command line.
#include <new>

#include "boxwood/error.h"
#include "command_line.h"
#include "console.h"
#include "exit_code.h"

int main(int count, char** arguments) {
  using namespace boxwood;
  cli::watch_for_interrupt();
  try {
    return cli::parse_command_line(count, arguments)();
  } catch (const Cancelled&) {
    cli::complain("stopped; nothing unfinished was written");
    return cli::exit_interrupted;
  } catch (const UsageError& error) {
    cli::complain(error.what());
    return cli::exit_usage;
  } catch (const Error& error) {
    cli::complain(error.what());
    return cli::exit_failed;
  } catch (const std::bad_alloc&) {
    cli::complain("there is not enough memory for this; try a smaller scene or a more compact recipe");
    return cli::exit_failed;
  } catch (const std::exception& error) {
    cli::complain(error.what());
    return cli::exit_failed;
  }
}
