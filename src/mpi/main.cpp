// SPDX-License-Identifier: Apache-2.0
#include <glog/logging.h>
#include <mpi.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/sweep_run.hpp"
#include "mpi/distribute.hpp"
#include "studies/published/published_toml.hpp"
#include "trueaxis/error.hpp"

/// trueaxis-mpi sweep SWEEP.toml -o DIR: the command of that name on the ranks of mpirun.
namespace trueaxis::mpi {
namespace {

/// mpirun ends the others so when a rank died.
extern "C" void say_how_to_go_on(int) {
  constexpr std::string_view text =
      "trueaxis-mpi: ended from outside; what is finished is in the journal, the same command "
      "continues\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(128 + SIGTERM);
}

struct Options {
  std::string sweep, folder;
  cli::Results results;
};

int lead(const Options& options) {
  bool agreed = false, working = false;
  const int code = cli::guarded([&] {
    const study::PublishedSweep file = read_published_sweep(options.sweep);
    const study::Sweep& sweep = file.sweep;
    cli::run_sweep(file, options.folder, options.results,
                   [&](const auto& blocks, const auto& finished) {
                     agree_on(sweep.input_hash);
                     agreed = working = true;
                     distribute(sweep, blocks, finished);
                     working = false;
                   });
    return cli::done;
  });
  if (!agreed) agree_on("");
  if (working) MPI_Abort(MPI_COMM_WORLD, code);  // ranks wait for answers that will not come
  return code;
}

int follow(const Options& options) {
  const int code = cli::guarded([&] {
    const std::string hash = agree_on("");
    if (hash.empty()) return cli::done;  // rank 0 says why
    const study::Sweep sweep = read_published_sweep(options.sweep).sweep;
    if (sweep.input_hash != hash)
      throw InputError(options.sweep, "differs between ranks: give all the same files");
    serve(sweep);
    return cli::done;
  });
  if (code != cli::done) MPI_Abort(MPI_COMM_WORLD, code);
  return code;
}

int run(int argc, char** argv, int rank) {
  CLI::App app{"TrueAxis' sweeps on several machines: mpirun -n 4 trueaxis-mpi sweep …"};
  app.set_version_flag("--version", "trueaxis-mpi " TRUEAXIS_VERSION);
  app.require_subcommand(1);
  Options options;
  CLI::App* command = app.add_subcommand("sweep", "as trueaxis study sweep, the same bytes");
  command->add_option("sweep", options.sweep, "sweep (TOML)")->required();
  command->add_option("-o,--output", options.folder, "folder of the results and the journal")
      ->required()
      ->check(cli::a_place());
  cli::add_json(*command, options.results, "trueaxis.sweep");
  cli::add_force(*command, options.results.force);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (rank != 0) return cli::done;
    return app.exit(error) == 0 ? cli::done : cli::usage;
  }
  return rank == 0 ? lead(options) : follow(options);
}

}  // namespace
}  // namespace trueaxis::mpi

int main(int argc, char** argv) {
  FLAGS_logtostderr = true;
  google::InitGoogleLogging(argv[0]);
  // A block's result is sent at once and not when rank 0 looks: Open MPI waits from 4 KiB on.
  setenv("OMPI_MCA_btl_vader_eager_limit", "65536", 0);
  int granted = 0, rank = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &granted);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) std::signal(SIGTERM, trueaxis::mpi::say_how_to_go_on);
  const int code = trueaxis::mpi::run(argc, argv, rank);
  MPI_Finalize();
  return code;
}
