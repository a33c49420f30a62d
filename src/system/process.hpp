// This process and its machine; others by their numbers.
#pragma once
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace phy::system {

int process_number();
/// Of the calling thread; in the first thread of a process that of the process.
int thread_number();
/// Of any process that can be seen from here.
bool thread_lives(const std::string& number);

/// Machine, boot and process namespace. Within one such world process numbers can be compared; of one machine
/// only the present boot lives.
struct World {
  std::string machine, boot, processes;
};
World this_world();

/// When a process was started; empty if there is no such process. Together with its number it names a process
/// for good.
std::string start_of(const std::string& process);

std::string host_name();
/// The words of the command line in UTF-8, without the name of the program.
std::vector<std::string> arguments(int argc, char** argv);
/// Processors that this process may use, at least one.
int n_processors();
/// CPU time of the calling thread [s].
double thread_seconds();
std::tm utc(std::time_t time);
/// Whether a port stays taken for a while after its process, unless it is asked to be shared. Where it does
/// not, asking would share it with a process that lives.
bool ports_linger();
/// Bytes that nobody can guess; false: the system has none.
bool random_bytes(unsigned char* to, std::size_t n);
/// Where this user's programs keep what can be made anew; empty: nowhere.
std::filesystem::path cache_folder();

}  // namespace phy::system
