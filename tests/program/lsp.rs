//! `urdd lsp` over standard input and output.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

struct Server {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
}

impl Server {
    fn start() -> Self {
        Server::run(&mut Command::new(env!("CARGO_BIN_EXE_urdd")))
    }

    fn run(command: &mut Command) -> Self {
        let mut child = command
            .args(["lsp", "--stdio"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program");
        Server {
            input: child.stdin.take(),
            output: BufReader::new(child.stdout.take().expect("its output")),
            child,
        }
    }

    fn send(&mut self, mut message: Value) {
        message["jsonrpc"] = json!("2.0");
        let text = message.to_string();
        let input = self.input.as_mut().expect("open");
        write!(input, "Content-Length: {}\r\n\r\n{text}", text.len()).expect("a server");
        input.flush().expect("a server");
    }

    /// The next message; nothing else is on its output.
    fn receive(&mut self) -> Value {
        let mut header = String::new();
        self.output.read_line(&mut header).expect("a header");
        let length = header.strip_prefix("Content-Length: ").expect("a header");
        let mut empty = String::new();
        self.output.read_line(&mut empty).expect("a header");
        assert_eq!(empty, "\r\n");
        let mut text = vec![0; length.trim().parse().expect("a length")];
        self.output.read_exact(&mut text).expect("a message");
        serde_json::from_slice(&text).expect("JSON")
    }

    fn initialize(&mut self) {
        self.initialize_with(&json!({}));
    }

    fn initialize_with(&mut self, options: &Value) {
        let params = json!({
            "processId": std::process::id(),
            "capabilities": {"textDocument": {"publishDiagnostics": {"relatedInformation": true}}},
            "initializationOptions": options,
        });
        self.send(json!({"id": 1, "method": "initialize", "params": params}));
        assert_eq!(self.receive()["result"]["serverInfo"]["name"], "urdd");
        self.send(json!({"method": "initialized", "params": {}}));
    }

    /// Its exit status, and what is left on its output.
    fn end(mut self) -> (Option<i32>, String) {
        self.input = None;
        let begun = Instant::now();
        while self.child.try_wait().expect("a process").is_none() {
            assert!(begun.elapsed() < Duration::from_secs(30), "it goes on");
            std::thread::sleep(Duration::from_millis(5));
        }
        let mut rest = String::new();
        self.output.read_to_string(&mut rest).expect("UTF-8");
        (self.child.wait().expect("a status").code(), rest)
    }
}

/// Opens a robot with a fault. Returns its address.
fn open_broken(server: &mut Server) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/robots/gripper.urdf");
    let uri = format!("file://{}", path.display());
    let text = std::fs::read_to_string(&path).expect("a robot");
    let item = json!({"uri": uri, "languageId": "xml", "version": 7, "text": text.replacen("</link>", "</lin>", 1)});
    server.send(json!({"method": "textDocument/didOpen", "params": {"textDocument": item}}));
    uri
}

#[test]
fn an_editor_opens_a_file_and_leaves() {
    let mut server = Server::start();
    server.initialize();
    let uri = open_broken(&mut server);
    let published = server.receive();
    assert_eq!(published["method"], "textDocument/publishDiagnostics");
    assert_eq!(
        (&published["params"]["uri"], &published["params"]["version"]),
        (&json!(uri), &json!(7))
    );
    assert_eq!(published["params"]["diagnostics"][0]["source"], "urdd");
    server.send(json!({"id": 2, "method": "shutdown"}));
    while server.receive()["id"] != 2 {}
    server.send(json!({"method": "exit"}));
    assert_eq!(server.end(), (Some(0), String::new()));
}

#[test]
fn an_editor_that_leaves_gets_no_more_findings() {
    let mut server = Server::start();
    server.initialize();
    open_broken(&mut server);
    server.send(json!({"id": 2, "method": "shutdown"}));
    while server.receive()["id"] != 2 {}
    // The findings that are computed meanwhile.
    std::thread::sleep(Duration::from_secs(1));
    server.send(json!({"method": "exit"}));
    assert_eq!(server.end(), (Some(0), String::new()));
}

#[test]
fn it_ends_when_its_input_does_or_is_no_message() {
    let mut server = Server::start();
    server.initialize();
    assert_eq!(server.end(), (Some(1), String::new()));
    assert_eq!(Server::start().end().0, Some(1));
    let mut server = Server::start();
    let input = server.input.as_mut().expect("open");
    input.write_all(b"GET / HTTP/1.1\r\n\r\nhello").expect("a server");
    assert_eq!(server.end(), (Some(2), String::new()));
}

#[test]
fn a_message_beyond_the_bound_is_refused_before_it_is_read() {
    let endless = format!("X: {}", "x".repeat(1 << 20));
    for (header, words) in [
        ("Content-Length: 99999999999\r\n\r\n", "99999999999 bytes; at most 134217728"),
        ("Content-Length: 134217729\r\n\r\n", "134217729 bytes; at most 134217728"),
        (endless.as_str(), "a header has more than 4096 bytes"),
    ] {
        let mut server = Command::new(env!("CARGO_BIN_EXE_urdd"))
            .arg("lsp")
            .stdin(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program");
        let mut input = server.stdin.take().expect("open");
        // It may end before it has read all.
        let _ = input.write_all(header.as_bytes());
        drop(input);
        let output = server.wait_with_output().expect("its output");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(words) && said.lines().count() == 1, "{said}");
    }
}

/// With the program in place of xacro that `urdd lint` is tried with.
#[cfg(unix)]
mod xacro {
    use super::*;
    use crate::lint::xacro::hand;
    use crate::xacro_places::{MADE, folder, notes};

    /// What is shown of a file after it is saved.
    fn saved(folder: &Path, file: &str) -> Vec<Value> {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        let mut server = Server::run(command.env("PATH", folder.join("bin")));
        server.initialize_with(&json!({"xacro": true, "debounce": 0}));
        let path = folder.canonicalize().expect("a folder").join(file);
        let text = std::fs::read_to_string(&path).expect("a file");
        let document = json!({"uri": format!("file://{}", path.display())});
        let mut item = document.clone();
        item["languageId"] = json!("xml");
        item["version"] = json!(1);
        item["text"] = json!(text);
        server.send(json!({"method": "textDocument/didOpen", "params": {"textDocument": item}}));
        let before = server.receive();
        assert_eq!(before["params"]["diagnostics"], json!([]), "before it is saved");
        server
            .send(json!({"method": "textDocument/didSave", "params": {"textDocument": document}}));
        let mut after = server.receive();
        server.send(json!({"id": 2, "method": "shutdown"}));
        while server.receive()["id"] != 2 {}
        server.send(json!({"method": "exit"}));
        assert_eq!(server.end().0, Some(0));
        let Value::Array(found) = after["params"]["diagnostics"].take() else { panic!("{after}") };
        found
    }

    #[test]
    fn a_finding_in_an_included_macro_is_shown_at_the_include_with_its_place() {
        let folder = hand("hand");
        let found = saved(folder.path(), "hand/hand.urdf.xacro");
        let axis = found.iter().find(|one| one["code"] == "LNT012").expect("LNT012");
        assert_eq!(axis["range"]["start"], json!({"line": 1, "character": 0}), "{axis}");
        let message = axis["message"].as_str().expect("a message");
        let words = "(written at parts/finger.xacro:6, in the macro `finger`)";
        assert!(message.contains("`left_slide`") && message.contains(words), "{message}");
        let place = &axis["relatedInformation"][0]["location"];
        assert!(place["uri"].as_str().expect("it").ends_with("/hand/parts/finger.xacro"));
        assert_eq!(place["range"]["start"]["line"], 5);
        let link = found.iter().find(|one| one["code"] == "LNT006").expect("LNT006");
        assert!(!link["message"].as_str().expect("it").contains("written"), "{link}");
    }

    #[test]
    fn a_value_of_a_call_is_shown_at_the_call_with_the_macro() {
        // The literal is in this file; in the second, in a YAML that the macro of another file reads.
        for (value, character, lines) in [
            (json!([0, 3, 1, "mass", ""]), 21, vec![4, 2]),
            (json!([2, 2, 4, "", ""]), 0, vec![1, 4, 2]),
        ] {
            let folder = folder(notes(value), MADE, 0);
            let found = saved(folder.path(), "urdf/r.urdf.xacro");
            let mass = found.iter().find(|one| one["code"] == "SRC003").expect("SRC003");
            let start = json!({"line": 2, "character": character});
            assert_eq!(mass["range"]["start"], start, "{mass}");
            let related = mass["relatedInformation"].as_array().expect("a list");
            let line = |one: &Value| one["location"]["range"]["start"]["line"].clone();
            assert_eq!(related.iter().map(line).collect::<Vec<_>>(), lines, "{mass}");
        }
    }

    #[test]
    fn a_robot_that_needs_arguments_is_an_information_until_it_is_declared() {
        let folder = crate::robots::package();
        let file = "arms/urdf/arm.urdf.xacro";
        let found = saved(folder.path(), file);
        let needs = |one: &&Value| {
            let message = one["message"].as_str().expect("a message");
            message.contains("the robot needs `type` (broken, long, short)")
        };
        let severities: Vec<&Value> =
            found.iter().filter(needs).map(|one| &one["severity"]).collect();
        assert_eq!(severities, [&json!(3)], "{found:#?}");
        let at = found.iter().find(needs).map(|one| &one["range"]["start"]["line"]);
        assert_eq!(at, Some(&json!(1)), "{found:#?}");
        let toml =
            "[[robot]]\npath = \"urdf/arm.urdf.xacro\"\nargs = { type = [\"long\", \"broken\"] }\n";
        std::fs::write(folder.path().join("arms/urdd.toml"), toml).expect("a file");
        let found = saved(folder.path(), file);
        assert_eq!(found.iter().filter(needs).count(), 0, "{found:#?}");
        assert!(found.iter().all(|one| one["severity"] != json!(1)), "{found:#?}");
    }

    #[test]
    fn a_baseline_is_that_of_the_declared_robot() {
        let folder = crate::robots::package();
        let root = folder.path();
        let script = "#!/bin/sh\necho \"<robot name='arm'><link name='a'/><link name='b'/>\
            <joint name='j' type='prismatic'><parent link='a'/><child link='b'/><axis xyz='0 0 2'/>\
            <limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>\"\n";
        std::fs::write(root.join("bin/xacro"), script).expect("written");
        let toml = "baseline = \"known.json\"\n[[robot]]\npath = \"urdf/arm.urdf.xacro\"\n\
            args = { type = [\"long\", \"short\"] }\n";
        std::fs::write(root.join("arms/urdd.toml"), toml).expect("written");
        for (kind, count) in [("short", 1), ("long", 0)] {
            let robot = format!("urdf/arm.urdf.xacro type:={kind}");
            let known = json!({"urdd_baseline": 1, "files": {robot: {"LNT012 joint `j`": 1}}});
            std::fs::write(root.join("arms/known.json"), known.to_string()).expect("written");
            let found = saved(root, "arms/urdf/arm.urdf.xacro");
            let axes = found.iter().filter(|one| one["code"] == "LNT012");
            assert_eq!(axes.count(), count, "{kind}: {found:#?}");
        }
    }

    #[test]
    fn a_misspelt_name_is_as_severe_as_what_follows_from_it() {
        let folder = hand("hand");
        let file = folder.path().join("hand/parts/finger.xacro");
        let text = std::fs::read_to_string(&file).expect("a file");
        std::fs::write(&file, text.replace(" velocity=", " velocty=")).expect("written");
        let found = saved(folder.path(), "hand/hand.urdf.xacro");
        let of = |code: &str| found.iter().filter(|one| one["code"] == code).count();
        assert_eq!((of("LNT040"), of("LNT017")), (1, 0), "{found:#?}");
        let misspelt = found.iter().find(|one| one["code"] == "LNT040");
        assert_eq!(misspelt.expect("it")["severity"], 1, "{misspelt:#?}");
    }

    #[test]
    fn a_file_that_others_include_is_no_robot_without_links() {
        let folder = hand("hand");
        let path = folder.path().join("hand/parts/finger.xacro");
        assert_eq!(saved(folder.path(), "hand/parts/finger.xacro"), [""; 0]);
        // With a name, and with macros alone.
        let text = std::fs::read_to_string(&path).expect("a file");
        let text = text.replace("<robot ", "<robot name=\"finger\" ");
        std::fs::write(&path, text).expect("written");
        assert_eq!(saved(folder.path(), "hand/parts/finger.xacro"), [""; 0]);
    }
}
