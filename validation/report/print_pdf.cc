#include "validation/report/print_pdf.h"

#include "synthetic/dataset/error.h"
#include "validation/report/child_process.h"
#include "validation/runner/result_files.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace pelvireg::report
{
namespace
{
namespace fs = std::filesystem;

/// A folder of our own, gone with the object.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (fs::temp_directory_path() / "pelvireg-pdf-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw std::runtime_error("No temporary folder can be made in " + fs::temp_directory_path().string());
    path_ = name;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;
  const fs::path &path() const { return path_; }

private:
  fs::path path_;
};

std::string content_of(const fs::path &file)
{
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// "/CreationDate (D:20260101…)" with every digit 0, except for the epoch's year, month and day.
void set_dates_to_epoch(std::string &pdf)
{
  for (const std::string key : {"/CreationDate (D:", "/ModDate (D:"})
    for (std::size_t at = pdf.find(key); at != std::string::npos; at = pdf.find(key, at + 1))
    {
      const std::size_t begin = at + key.size(), end = pdf.find(')', begin);
      const std::string epoch = "19700101000000";
      for (std::size_t i = 0; begin + i < end && i < epoch.size(); ++i)
        pdf[begin + i] = epoch[i];
    }
}

void run_chromium(const fs::path &chromium, const fs::path &folder, double time_limit_s)
{
  std::vector<std::string> words = {chromium.string(),
                                    "--headless=new",
                                    "--disable-gpu",
                                    "--no-pdf-header-footer",
                                    "--user-data-dir=" + (folder / "profile").string(),
                                    "--print-to-pdf=" + (folder / "page.pdf").string()};
  if (::geteuid() == 0)
    words.emplace_back("--no-sandbox"); // it has none for root; the page is our own
  words.push_back("file://" + (folder / "page.html").string());
  const pid_t child = start_child(words, {folder / "chromium.log", ""});
  const auto status = child < 0 ? std::nullopt : wait_for_child(child, time_limit_s);
  if (child >= 0 && !status)
    end_child(child);
  if (!status || !WIFEXITED(*status) || WEXITSTATUS(*status) != 0)
    throw std::runtime_error(fmt::format("Chromium ({}) did not print the summary within {:g} s; it said: {}",
                                         chromium.string(), time_limit_s,
                                         content_of(folder / "chromium.log").substr(0, 300)));
}
} // namespace

void print_pdf(const std::string &html, const fs::path &file, double time_limit_s)
{
  const auto chromium = find_in_path("chromium");
  if (!chromium)
    throw InputError("A PDF is printed by Chromium, and there is no program 'chromium' in PATH; install the package "
                     "chromium, or print report.html from a browser");
  const TemporaryFolder folder;
  runner::write_text_file(folder.path() / "page.html", html);
  run_chromium(*chromium, folder.path(), time_limit_s);
  std::string pdf = content_of(folder.path() / "page.pdf");
  if (pdf.rfind("%PDF-", 0) != 0)
    throw std::runtime_error("Chromium (" + chromium->string() + ") ended well and wrote no PDF");
  set_dates_to_epoch(pdf);
  runner::write_text_file(file, pdf);
}
} // namespace pelvireg::report
