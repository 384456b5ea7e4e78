// The extension: starts `urdd lsp`, and shows robots by `urdd view`.

import { statSync } from "node:fs";
import { homedir } from "node:os";
import { resolve } from "node:path";
import {
  commands,
  env,
  Uri,
  window,
  workspace,
  type ExtensionContext,
  type LogOutputChannel,
  type WorkspaceConfiguration,
} from "vscode";
import {
  DidChangeConfigurationNotification,
  LanguageClient,
  type LanguageClientOptions,
} from "vscode-languageclient/node";
import { find, notFound, section, withPackages, type Settings } from "./program";
import { compared, target, Viewers, type Robots } from "./viewers";

const viewers = new Viewers();
let client: LanguageClient | undefined;
/** Starts and stops happen one after the other. */
let turn = Promise.resolve();

export async function activate(context: ExtensionContext): Promise<void> {
  const log = window.createOutputChannel("URDD", { log: true });
  const restart = () => (turn = turn.then(stop).then(() => start(log)));
  context.subscriptions.push(
    log,
    commands.registerCommand("urdd.restart", restart),
    commands.registerCommand("urdd.show", show),
    commands.registerCommand("urdd.compare", compare),
    workspace.onDidChangeConfiguration((change) => {
      if (change.affectsConfiguration("urdd.path")) void restart();
      else if (change.affectsConfiguration("urdd")) void announce();
    }),
    workspace.onDidGrantWorkspaceTrust(announce),
  );
  await restart();
}

export async function deactivate(): Promise<void> {
  viewers.stop();
  await turn.then(stop);
}

function configuration(): WorkspaceConfiguration {
  return workspace.getConfiguration("urdd");
}

/** What the server gets. xacro runs code: never in a workspace that is not trusted, whatever the user's own settings. */
function settings(): Settings {
  const root = workspace.workspaceFolders?.[0]?.uri.fsPath ?? homedir();
  const baseline = configuration().get<string>("baseline", "");
  return {
    xacro: workspace.isTrusted && configuration().get("xacro", false),
    packagePaths: configuration()
      .get<string[]>("packagePaths", [])
      .map((path) => resolve(root, path)),
    baseline: baseline === "" ? "" : resolve(root, baseline),
  };
}

/** The program's path; says what to do if there is none. */
async function program(): Promise<string | null> {
  const name = configuration().get("path", "urdd");
  const found = find(name, process.env);
  if (found !== null) return found;
  const open = "Open settings";
  if ((await window.showErrorMessage(notFound(name), open)) === open) {
    await commands.executeCommand("workbench.action.openSettings", "urdd.path");
  }
  return null;
}

async function start(log: LogOutputChannel): Promise<void> {
  const command = find(configuration().get("path", "urdd"), process.env);
  if (command === null) {
    // Not awaited: the message stays until somebody closes it.
    void program();
    return;
  }
  const options: LanguageClientOptions = {
    documentSelector: [
      { scheme: "file", pattern: "**/*.{urdf,xacro}" },
      { scheme: "file", pattern: "**/urdd.json" },
      { scheme: "file", pattern: "**/*_module/module.{json,yaml}" },
    ],
    initializationOptions: settings,
    outputChannel: log,
    middleware: {
      workspace: {
        configuration: async (asked, token, next) => {
          const others: unknown = await next(asked, token);
          const own = settings();
          return asked.items.map((item, index) => section(own, item.section) ?? (others as unknown[])[index]);
        },
      },
    },
  };
  client = new LanguageClient("urdd", "URDD", { command, args: ["lsp"] }, options);
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    log.error(`${command} lsp: ${String(error)}`);
    void window.showErrorMessage(`The language server did not start. \`${command}\` has to be urdd 1.1.0 or later.`);
  }
}

async function stop(): Promise<void> {
  const running = client;
  client = undefined;
  await running?.stop().catch(() => undefined);
}

/** Tells the server that settings changed; one that wants them asks. */
async function announce(): Promise<void> {
  await client?.sendNotification(DidChangeConfigurationNotification.type, { settings: { urdd: settings() } });
}

/** Opens the page with the robot of a file: that of the menu, or of the editor. */
async function show(chosen?: unknown): Promise<void> {
  const uri = chosen instanceof Uri ? chosen : window.activeTextEditor?.document.uri;
  const robot = uri?.scheme === "file" ? target(uri.fsPath) : null;
  if (robot === null) {
    void window.showErrorMessage("Open a .urdf or .xacro file, or the urdd.json of a URDD: that robot is shown.");
    return;
  }
  await open([robot]);
}

/** Opens the page with two selected robots, side by side. */
async function compare(_chosen?: unknown, selected?: unknown): Promise<void> {
  const all: unknown[] = Array.isArray(selected) ? selected : [];
  const files = all.flatMap((uri) => (uri instanceof Uri && uri.scheme === "file" ? [uri.fsPath] : []));
  const robots = compared(files, (file) => statSync(file, { throwIfNoEntry: false })?.mtimeMs ?? 0);
  if (robots === null) {
    void window.showErrorMessage(
      "Select two robots in the explorer: .urdf or .xacro files, or the urdd.json of URDDs. The older one is drawn left.",
    );
    return;
  }
  await open(robots);
}

async function open(robots: Robots): Promise<void> {
  if (robots.some((robot) => /\.xacro$/i.test(robot)) && !settings().xacro) {
    const why = workspace.isTrusted ? "allow it by `urdd.xacro`" : "trust this workspace, and allow it by `urdd.xacro`";
    void window.showErrorMessage(`xacro runs code that the file contains. To show this robot, ${why}.`);
    return;
  }
  const command = await program();
  if (command === null) return;
  const variables = withPackages(settings(), process.env);
  try {
    const address = await viewers.address(command, robots, variables);
    // On another machine, VS Code forwards the port, and needs the address itself.
    const isHere = env.remoteName === undefined;
    await env.openExternal(isHere ? Uri.file(viewers.page(address)) : Uri.parse(address, true));
  } catch (error) {
    void window.showErrorMessage(error instanceof Error ? error.message : String(error));
  }
}
