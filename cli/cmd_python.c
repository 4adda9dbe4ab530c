#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/commands.h"
#include "cli/report.h"

/* What Python is given: the package from where it is installed, not from a folder `hypofab` that one happens to be in.
 */
static const char launch[] =
    "import sys\n"
    "if sys.path[0] == '': del sys.path[0]\n"
    "try:\n"
    "  from hypofab.__main__ import main\n"
    "except ModuleNotFoundError as error:\n"
    "  if error.name != 'hypofab': raise\n"
    "  print(f'hypofab {sys.argv[1]}: a command of the Python package, which {sys.executable} does not have: '\n"
    "        'pip install hypofab, or name another Python in HYPOFAB_PYTHON', file=sys.stderr)\n"
    "  sys.exit(2)\n"
    "sys.exit(main(sys.argv[1:]))\n";

int cmd_python(int argc, char **argv) {
  const char *named = getenv("HYPOFAB_PYTHON");
  const char *python = named && *named ? named : "python3";
  char **call = malloc(((size_t)argc + 4) * sizeof *call);
  if (!call) return CLI_INTERNAL_ERROR;
  call[0] = (char *)python;
  call[1] = "-c";
  call[2] = (char *)launch;
  call[3] = strchr(argv[0], ' ') + 1; /* "hypofab plot": the command */
  for (int i = 1; i <= argc; ++i) call[i + 3] = argv[i];
  execvp(python, call);
  fprintf(stderr, "%s: a command of the Python package (pip install hypofab), but '%s' does not start: %s\n", argv[0],
          python, strerror(errno));
  free(call);
  return CLI_BAD_INPUT;
}
