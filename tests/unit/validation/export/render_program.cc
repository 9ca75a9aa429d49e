// Stands in for `pelvireg render RESULT FOLDER` in the test: the same function, the built-in example instead of files.
#include "tests/unit/validation/export/example.h"
#include "validation/report/pictures.h"

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <thread>

int main(int argc, char **argv)
{
  using namespace pelvireg::report;
  if (argc != 4 || std::string(argv[1]) != "render")
    return 2;
  const std::string result = argv[2];
  if (result == "abort")
    std::abort();
  if (result == "hang")
    std::this_thread::sleep_for(std::chrono::hours(1));
  if (result == "fail")
  {
    std::cerr << "the anatomy is missing\n";
    return 3;
  }
  render_pictures(test::example_anatomy(), test::example_truth(), {test::example_estimate()}, argv[3]);
}
