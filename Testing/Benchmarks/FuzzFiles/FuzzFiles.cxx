// Damages files of every form that the command reads and gives each to the command in a process of
// its own, which may take neither much memory nor time. Prints, per form, how the command ended,
// and every find: a crash, a hang, memory beyond the limit, an error without its one line of
// message, or a file left behind. Exits with an error if there is any. An input depends on nothing
// but its number and the seed, so `--from N --count 1 --keep DIR` makes it again.
#include "Failure.h"
#include "FuzzInputs.h"
#include "Messages.h"
#include "Mutation.h"
#include "Program.h"
#include "Run.h"
#include "SurfaceFile.h"
#include "VolumeFile.h"

#include "vtkFlipFreeSegmentation.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// GCC tells it by a macro, Clang by a feature.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FLIPFREE_HAS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define FLIPFREE_HAS_SANITIZER
#endif

#if defined(FLIPFREE_HAS_SANITIZER)
#undef FLIPFREE_HAS_SANITIZER
// An error is told from a refusal by its status; leaks of other people's readers are no finds here.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options()
{
  return "exitcode=99:detect_leaks=0:allocator_may_return_null=1:soft_rss_limit_mb=0";
}
constexpr bool HasSanitizer = true;
#else
constexpr bool HasSanitizer = false;
#endif

namespace
{

namespace fs = std::filesystem;

volatile std::sig_atomic_t Stopped = 0; // prints the table, too

void Stop(int)
{
  Stopped = 1;
}

using Clock = std::chrono::steady_clock;

struct Settings
{
  long From = 0;
  long Count = 1000;
  long Seed = 2026;
  int Jobs = 2;
  double Seconds = 5; ///< of the processor, for one input
  double Total = 0;   ///< of the clock, for all; 0: no limit
  long Megabytes = 1024;
  std::string Only;
  std::string Keep;
};

/// How the command is called with a damaged file.
enum class Use
{
  Segmentation,
  Reference,
  Volume,
  Start
};

struct Try
{
  std::size_t Form = 0;
  Use With = Use::Segmentation;
  FuzzInput Damaged;
};

Try MakeTry(const std::vector<FuzzInput>& inputs, long index, const Settings& settings)
{
  std::seed_seq seed{ settings.Seed, index };
  std::mt19937_64 random(seed);
  Try made;
  made.Form = static_cast<std::size_t>(index) % inputs.size();
  FuzzInput& input = made.Damaged = inputs[made.Form];
  const auto chance = [&random](int of) { return random() % static_cast<unsigned int>(of) == 0; };
  made.With = input.IsSurface ? (chance(2) ? Use::Start : Use::Segmentation)
    : chance(3)               ? Use::Volume
    : chance(2)               ? Use::Reference
                              : Use::Segmentation;
  if (index < static_cast<long>(inputs.size()))
  {
    made.With = Use::Segmentation; // whole, and must be read
    return made;
  }
  const FuzzInput& other = inputs[random() % inputs.size()];
  const auto chosen = std::next(input.Files.begin(),
    static_cast<std::ptrdiff_t>(
      chance(3) || input.Main.empty() ? random() % input.Files.size() : 0));
  std::string& bytes = chosen->second;
  const bool inside = input.IsPacked && !chance(3);
  bytes = Mutated(inside ? Inflated(bytes) : bytes, input.Header, input.IsText,
    other.Files.begin()->second, random);
  if (inside)
  {
    bytes = Deflated(bytes);
  }
  return made;
}

/// The start of a segmentation, which the command does not take yet.
int SegmentFrom(const std::string& surface, const std::string& volume)
{
  Command::CatchVtkMessages();
  try
  {
    vtkNew<vtkFlipFreeSegmentation> segmentation;
    segmentation->SetInputDataObject(Command::ReadVolume(volume));
    segmentation->SetStartData(Command::ReadSurface(surface));
    segmentation->SetSeedCenter(5.5, 4.5, 5.25);
    segmentation->SetSeedRadius(2.19);
    segmentation->SetMaximumIterations(1);
    Command::Run(segmentation, "segmenting");
    return Command::SUCCESS;
  }
  catch (const std::bad_alloc&)
  {
    Command::PrintError("Out of memory.");
  }
  catch (const std::exception& error)
  {
    Command::PrintError(error.what());
  }
  return Command::FAILURE;
}

int RunOn(const std::string& file, Use use, const std::string& bases, const std::string& results)
{
  const std::string truth = bases + "/truth.nii";
  std::vector<std::string> words;
  switch (use)
  {
    case Use::Segmentation:
      words = { "flipfree", "evaluate", file, truth, "--csv", results + "/out.csv" };
      break;
    case Use::Reference:
      words = { "flipfree", "evaluate", truth, file, "--csv", results + "/out.csv" };
      break;
    case Use::Volume:
      words = { "flipfree", "segment", file, "--seed-voxel", "6", "5", "4", "--radius", "2.2",
        "--iterations", "1", "--levels", "1", "--resolution", "4", "-o", results + "/out.vtp" };
      break;
    case Use::Start:
      return SegmentFrom(file, bases + "/ball.nii");
  }
  std::vector<char*> arguments;
  arguments.reserve(words.size());
  for (std::string& word : words)
  {
    arguments.push_back(&word[0]);
  }
  return Command::RunCommand(static_cast<int>(arguments.size()), arguments.data());
}

void Limit(int resource, rlim_t value)
{
  const rlimit limit{ value, value };
  setrlimit(resource, &limit);
}

/// The part of a process in which the command runs.
[[noreturn]] void RunChild(const Try& attempt, const Settings& settings, const std::string& bases,
  const std::string& folder)
{
  const std::string inputs = folder + "/in";
  const std::string results = folder + "/out";
  fs::create_directories(inputs);
  fs::create_directories(results);
  for (const auto& [name, bytes] : attempt.Damaged.Files)
  {
    WriteWhole((fs::path(inputs) / name).string(), bytes);
  }
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  const int errors = open((folder + "/err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(errors, STDERR_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDIN_FILENO);
  Limit(RLIMIT_CORE, 0);
  Limit(RLIMIT_CPU, static_cast<rlim_t>(settings.Seconds + 1) * (HasSanitizer ? 10 : 1));
  Limit(RLIMIT_FSIZE, 1 << 26);
  if (!HasSanitizer)
  {
    // Address space, of which threads take more than they use; what is used is measured.
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const auto bytes = static_cast<rlim_t>(settings.Megabytes) << 20;
    Limit(RLIMIT_AS, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + 2 * bytes);
  }
  const std::string name =
    attempt.Damaged.Main.empty() ? inputs : (fs::path(inputs) / attempt.Damaged.Main).string();
  const int status = RunOn(name, attempt.With, bases, results);
  std::fflush(nullptr);
  _exit(status);
}

struct Child
{
  long Index = -1;
  Try Attempt;
  std::string Folder;
  Clock::time_point Begin;
  bool IsLate = false;
  bool IsWhole = false; ///< not damaged
};

struct Tally
{
  long Read = 0;
  long Refused = 0;
  long Finds = 0;
  double Seconds = 0;
  double GreatestSeconds = 0;
  long GreatestMegabytes = 0;
};

/// What is wrong with how the command ended; empty if nothing is.
std::string Judge(const Child& child, int state, double seconds, long megabytes,
  const std::string& errors, const Settings& settings)
{
  if (child.IsLate)
  {
    return "it does not end";
  }
  if (WIFSIGNALED(state))
  {
    return WTERMSIG(state) == SIGXCPU || WTERMSIG(state) == SIGKILL
      ? "it takes too long"
      : std::string("signal ") + strsignal(WTERMSIG(state));
  }
  if (seconds > settings.Seconds * (HasSanitizer ? 10 : 1))
  {
    return "it takes " + std::to_string(seconds) + " s";
  }
  if (!HasSanitizer && megabytes > settings.Megabytes)
  {
    return "it takes " + std::to_string(megabytes) + " MiB";
  }
  const int status = WEXITSTATUS(state);
  const bool failed = status == Command::FAILURE || status == Command::WRONG_USAGE;
  std::istringstream lines(errors);
  long errorLines = 0;
  for (std::string line; std::getline(lines, line);)
  {
    errorLines += line.rfind("flipfree: error: ", 0) == 0 ? 1 : 0;
    if (line.rfind("flipfree: ", 0) != 0)
    {
      return "stray output: " + line;
    }
  }
  if (status != Command::SUCCESS && !failed)
  {
    return "status " + std::to_string(status);
  }
  if (child.IsWhole && status != Command::SUCCESS && child.Attempt.Damaged.IsRead)
  {
    return "a whole file is refused: " + errors;
  }
  if (errorLines != (failed ? 1 : 0))
  {
    return std::to_string(errorLines) + " errors with status " + std::to_string(status);
  }
  if (failed && errors.find("memory") != std::string::npos)
  {
    return "it wants more memory than is available";
  }
  long files = 0;
  for (const auto& entry : fs::directory_iterator(child.Folder + "/out"))
  {
    files += 1;
    if (failed || entry.path().filename().string().rfind("out.", 0) != 0)
    {
      return "it leaves " + entry.path().filename().string();
    }
  }
  return !failed && files == 0 && child.Attempt.With != Use::Start ? "it writes nothing" : "";
}

class Fuzzer
{
public:
  Fuzzer(const Settings& settings, const std::string& folder)
    : With(settings)
    , Folder(folder)
    , Inputs(MakeFuzzInputs(folder))
    , Tallies(this->Inputs.size())
  {
  }

  bool Run()
  {
    const Clock::time_point begin = Clock::now();
    long next = this->With.From;
    const long end = this->With.From + this->With.Count;
    const auto isOver = [&]()
    {
      const std::chrono::duration<double> passed = Clock::now() - begin;
      return Stopped != 0 || next >= end ||
        (this->With.Total > 0 && passed.count() > this->With.Total);
    };
    while (!isOver() || !this->Children.empty())
    {
      while (!isOver() && static_cast<int>(this->Children.size()) < this->With.Jobs)
      {
        this->Start(next++);
      }
      this->Collect();
    }
    this->Print(next);
    return this->Finds == 0;
  }

private:
  void Start(long index)
  {
    Child child;
    child.Index = index;
    if (!this->With.Only.empty() &&
      this->Inputs[static_cast<std::size_t>(index) % this->Inputs.size()].Name != this->With.Only)
    {
      return;
    }
    child.Attempt = MakeTry(this->Inputs, index, this->With);
    child.Folder = this->Folder + "/" + std::to_string(index);
    child.Begin = Clock::now();
    child.IsWhole = index < static_cast<long>(this->Inputs.size());
    fs::create_directory(child.Folder);
    std::fflush(nullptr);
    const pid_t process = fork();
    if (process == 0)
    {
      RunChild(child.Attempt, this->With, this->Folder, child.Folder);
    }
    if (process < 0)
    {
      throw std::runtime_error("No process can be started.");
    }
    this->Children.emplace(process, std::move(child));
  }

  void Collect()
  {
    int state = 0;
    rusage usage = {};
    const pid_t process = wait4(-1, &state, WNOHANG, &usage);
    if (process <= 0)
    {
      usleep(500);
      // One that waits uses no processor. Machines are busy: far more patience than for work.
      const auto patience = std::chrono::duration<double>(this->With.Seconds * 12);
      for (auto& [running, child] : this->Children)
      {
        if (Clock::now() - child.Begin > patience && !child.IsLate)
        {
          child.IsLate = true;
          kill(running, SIGKILL);
        }
      }
      return;
    }
    const auto found = this->Children.find(process);
    if (found == this->Children.end())
    {
      return;
    }
    this->Count(found->second, state, usage);
    if (this->With.Keep.empty())
    {
      std::error_code ignored;
      fs::remove_all(found->second.Folder, ignored);
    }
    this->Children.erase(found);
  }

  void Count(const Child& child, int state, const rusage& usage)
  {
    const double seconds = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
      1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    const long megabytes = usage.ru_maxrss >> 10;
    const std::string errors = ReadWhole(child.Folder + "/err");
    const std::string find = Judge(child, state, seconds, megabytes, errors, this->With);
    Tally& tally = this->Tallies[child.Attempt.Form];
    const bool succeeded = WIFEXITED(state) && WEXITSTATUS(state) == 0;
    ++(!find.empty() ? tally.Finds : succeeded ? tally.Read : tally.Refused);
    tally.Seconds += seconds;
    tally.GreatestSeconds = std::max(tally.GreatestSeconds, seconds);
    tally.GreatestMegabytes = std::max(tally.GreatestMegabytes, megabytes);
    if (!find.empty())
    {
      ++this->Finds;
      const char* const uses[] = { "segmentation", "reference", "volume", "start" };
      std::printf("find: --seed %ld --from %ld --count 1 (%s as %s): %s\n", this->With.Seed,
        child.Index, this->Inputs[child.Attempt.Form].Name.c_str(),
        uses[static_cast<int>(child.Attempt.With)], find.c_str());
      std::fflush(stdout);
    }
    if (!this->With.Keep.empty())
    {
      std::printf("%ld: %s\n%s", child.Index, find.empty() ? "no find" : find.c_str(),
        errors.c_str());
      fs::create_directories(this->With.Keep);
      fs::rename(child.Folder, this->With.Keep + "/" + std::to_string(child.Index));
    }
  }

  void Print(long next) const
  {
    std::puts("| form | inputs | read | refused | finds | mean s | greatest s | greatest MiB |\n"
              "|---|---|---|---|---|---|---|---|");
    Tally sum;
    const auto print = [](const std::string& name, const Tally& tally)
    {
      const long all = tally.Read + tally.Refused + tally.Finds;
      std::printf("| %-26s | %6ld | %6ld | %6ld | %3ld | %.3f | %.2f | %ld |\n", name.c_str(), all,
        tally.Read, tally.Refused, tally.Finds,
        all ? tally.Seconds / static_cast<double>(all) : 0.0, tally.GreatestSeconds,
        tally.GreatestMegabytes);
    };
    for (std::size_t form = 0; form < this->Inputs.size(); ++form)
    {
      const Tally& tally = this->Tallies[form];
      print(this->Inputs[form].Name, tally);
      sum.Read += tally.Read;
      sum.Refused += tally.Refused;
      sum.Finds += tally.Finds;
      sum.Seconds += tally.Seconds;
      sum.GreatestSeconds = std::max(sum.GreatestSeconds, tally.GreatestSeconds);
      sum.GreatestMegabytes = std::max(sum.GreatestMegabytes, tally.GreatestMegabytes);
    }
    print("all", sum);
    std::printf("to continue: --seed %ld --from %ld\n", this->With.Seed, next);
  }

  Settings With;
  std::string Folder;
  std::vector<FuzzInput> Inputs;
  std::vector<Tally> Tallies;
  std::map<pid_t, Child> Children;
  long Finds = 0;
};

/// In a process of its own, because it starts threads, after which this one could not fork well.
void WriteBasesInChild(const std::string& folder)
{
  const pid_t process = fork();
  if (process == 0)
  {
    try
    {
      WriteFuzzBases(folder);
    }
    catch (const std::exception& error)
    {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(1);
    }
    _exit(0);
  }
  int state = 1;
  waitpid(process, &state, 0);
  if (state != 0)
  {
    throw std::runtime_error("The whole files cannot be made.");
  }
}

} // namespace

int main(int argc, char* argv[])
{
  Settings settings;
  CLI::App app("Gives damaged files of every form to the command.");
  app.add_option("--from", settings.From, "number of the first input")->capture_default_str();
  app.add_option("--count", settings.Count, "inputs")->capture_default_str();
  app.add_option("--seed", settings.Seed, "of the damages")->capture_default_str();
  app.add_option("--jobs", settings.Jobs, "processes at a time")->capture_default_str();
  app.add_option("--seconds", settings.Seconds, "of the processor that an input may take")
    ->capture_default_str();
  app.add_option("--total-seconds", settings.Total, "after which no input is begun; 0: all are")
    ->capture_default_str();
  app.add_option("--megabytes", settings.Megabytes, "that an input may take")
    ->capture_default_str();
  app.add_option("--only", settings.Only, "inputs of this form, by its name in the table");
  app.add_option("--keep", settings.Keep, "folder for inputs and messages");
  CLI11_PARSE(app, argc, argv);
  try
  {
    std::string folder = (fs::temp_directory_path() / "FuzzFiles-XXXXXX").string();
    if (!mkdtemp(&folder[0]))
    {
      throw std::runtime_error("No temporary folder can be made.");
    }
    WriteBasesInChild(folder);
    std::signal(SIGINT, Stop);
    std::signal(SIGTERM, Stop);
    const bool isClean = Fuzzer(settings, folder).Run();
    fs::remove_all(folder);
    return isClean ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
