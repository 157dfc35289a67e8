#include "commands/commands.hpp"

namespace ballflow::cli {

void add_commands(const Command& program, Common& common, Action& action) {
  program
      .option("--plugin", common.plugins,
              "a node library, a folder of them, or a *.py with nodes, to load besides the built-in ones")
      .type_name("PATH");
  for (const auto add :
       {add_run,     add_sweep,    add_compare, add_plan,      add_runs,       add_check,
        add_nodes,   add_cache,    add_report,  add_export,    add_graph,      add_view,
        add_plugins, add_new_node, add_explain, add_render,    add_look,       add_spheres,
        add_submit,  add_status,   add_cancel,  add_exec_node, add_completion, add_version}) {
    add(program, common, action);
  }
}

}  // namespace ballflow::cli
