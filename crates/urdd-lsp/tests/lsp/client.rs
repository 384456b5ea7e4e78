//! An editor.

use std::path::{Path, PathBuf};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use lsp_server::{Connection, Message, Notification, Request, RequestId, Response};
use serde_json::{Value, json};
use urdd_lsp::{Ended, serve};

/// How long an answer may take.
const PATIENCE: Duration = Duration::from_secs(60);

pub struct Client {
    pub connection: Connection,
    pub server: JoinHandle<Ended>,
    next: i32,
    /// What was published, in order.
    pub published: Vec<Value>,
    /// Requests of the server.
    pub asked: Vec<Request>,
}

/// A robot with a fault in an axis, and one in a centre of mass, which only shapes show.
pub const ARM: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <material name="grey">
    <color rgba="0.5 0.5 0.5 1"/>
  </material>
  <link name="base">
    <visual>
      <geometry><mesh filename="meshes/part.stl" scale="0.001 0.001 0.001"/></geometry>
      <material name="grey"/>
    </visual>
  </link>
  <link name="upper">
    <inertial>
      <origin xyz="9 0 0"/>
      <mass value="2.5"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
    <collision>
      <geometry><box size="0.2 0.2 0.2"/></geometry>
    </collision>
  </link>
  <link name="lower"/>
  <joint name="shoulder" type="prismatic">
    <origin xyz="0 0 1" rpy="0 0 0.5"/>
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 0 2"/>
    <limit lower="-1" upper="1.5" effort="10" velocity="2"/>
  </joint>
  <joint name="elbow" type="prismatic">
    <origin xyz="1 0 0"/>
    <parent link="upper"/>
    <child link="lower"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
    <mimic joint="shoulder" multiplier="2" offset="0.1"/>
  </joint>
</robot>
"#;

/// Settings of a client that can do everything.
pub fn able() -> Value {
    json!({
        "textDocument": {
            "publishDiagnostics": {"relatedInformation": true},
            "documentSymbol": {"hierarchicalDocumentSymbolSupport": true},
            "codeAction": {"codeActionLiteralSupport": {"codeActionKind": {"valueSet": []}}},
        },
        "workspace": {"workspaceEdit": {"documentChanges": true}},
    })
}

impl Client {
    /// Connects, without a delay before findings.
    pub fn new() -> Self {
        Client::with(json!({"debounce": 0}), able())
    }

    pub fn with(options: Value, capabilities: Value) -> Self {
        let mut client = Client::connected();
        let answer = client.request(
            "initialize",
            json!({
                "processId": std::process::id(),
                "rootUri": null,
                "capabilities": capabilities,
                "initializationOptions": options,
            }),
        );
        assert!(answer["capabilities"]["hoverProvider"].as_bool().unwrap());
        client.notify("initialized", json!({}));
        client
    }

    /// Connects without a word.
    pub fn connected() -> Self {
        let (connection, others) = Connection::memory();
        Client {
            connection,
            server: std::thread::spawn(move || serve(others)),
            next: 1,
            published: Vec::new(),
            asked: Vec::new(),
        }
    }

    pub fn notify(&self, method: &str, params: Value) {
        let notification = Notification::new(method.to_owned(), params);
        self.connection.sender.send(notification.into()).expect("a server");
    }

    pub fn ask(&mut self, method: &str, params: Value) -> RequestId {
        let id = RequestId::from(self.next);
        self.next += 1;
        let request = Request::new(id.clone(), method.to_owned(), params);
        self.connection.sender.send(request.into()).expect("a server");
        id
    }

    /// The answer to a request.
    pub fn answer(&mut self, id: &RequestId) -> Response {
        loop {
            if let Some(response) = self.receive().filter(|response| response.id == *id) {
                return response;
            }
        }
    }

    pub fn request(&mut self, method: &str, params: Value) -> Value {
        let id = self.ask(method, params);
        let response = self.answer(&id);
        response.response_result.unwrap_or_else(|error| panic!("{method}: {error:?}"))
    }

    /// Takes in one message; returns it if it is a response.
    fn receive(&mut self) -> Option<Response> {
        match self.connection.receiver.recv_timeout(PATIENCE).expect("a message") {
            Message::Response(response) => return Some(response),
            Message::Notification(one) if one.method == "textDocument/publishDiagnostics" => {
                self.published.push(one.params);
            }
            Message::Notification(one) => assert_eq!(one.method, "window/logMessage"),
            Message::Request(request) => self.asked.push(request),
        }
        None
    }

    pub fn open(&self, uri: &str, text: &str) {
        self.open_as(uri, "urdf", text);
    }

    pub fn open_as(&self, uri: &str, language: &str, text: &str) {
        let item = json!({"uri": uri, "languageId": language, "version": 1, "text": text});
        self.notify("textDocument/didOpen", json!({"textDocument": item}));
    }

    pub fn change(&self, uri: &str, version: i32, text: &str) {
        self.edit(uri, version, json!([{"text": text}]));
    }

    pub fn edit(&self, uri: &str, version: i32, changes: Value) {
        let document = json!({"uri": uri, "version": version});
        let params = json!({"textDocument": document, "contentChanges": changes});
        self.notify("textDocument/didChange", params);
    }

    pub fn save(&self, uri: &str) {
        self.notify("textDocument/didSave", json!({"textDocument": {"uri": uri}}));
    }

    /// The findings of a version as soon as they are as wanted.
    pub fn until(&mut self, version: i32, wanted: impl Fn(&[Value]) -> bool) -> Vec<Value> {
        let begun = Instant::now();
        let mut next = 0;
        loop {
            while let Some(params) = self.published.get(next) {
                next += 1;
                let found = params["diagnostics"].as_array().expect("a list");
                if params["version"] == version && wanted(found) {
                    return found.clone();
                }
            }
            let found = self.published.last();
            assert!(begun.elapsed() < PATIENCE, "{found:#?}");
            self.receive();
        }
    }

    /// The findings with a code, once there are some.
    pub fn with_code(&mut self, version: i32, code: &str) -> Vec<Value> {
        let all = self.until(version, |found| found.iter().any(|one| one["code"] == code));
        all.into_iter().filter(|one| one["code"] == code).collect()
    }

    /// What is asked about the place of `needle` in a text, `after` characters behind its start.
    pub fn at(&mut self, method: &str, uri: &str, text: &str, needle: &str, after: usize) -> Value {
        let offset = text.find(needle).unwrap_or_else(|| panic!("no {needle}")) + after;
        let params = json!({"textDocument": {"uri": uri}, "position": position(text, offset)});
        self.request(method, params)
    }

    /// Ends the connection, and waits for the server.
    pub fn close(self) -> Ended {
        drop(self.connection);
        self.server.join().expect("no panic")
    }
}

/// The position of a byte, in UTF-16.
pub fn position(text: &str, offset: usize) -> Value {
    let before = &text[..offset];
    let line = before.rsplit('\n').next().unwrap_or_default();
    json!({"line": before.matches('\n').count(), "character": line.encode_utf16().count()})
}

/// What a range covers, in UTF-16.
pub fn covered(text: &str, range: &Value) -> String {
    let offset = |position: &Value| {
        let line = position["line"].as_u64().unwrap() as usize;
        let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        let mut left = position["character"].as_u64().unwrap() as usize;
        let mut at = start;
        for c in text[start..].chars() {
            if left == 0 {
                break;
            }
            left -= c.len_utf16();
            at += c.len_utf8();
        }
        at
    };
    text[offset(&range["start"])..offset(&range["end"])].to_owned()
}

/// A folder with the robot and its mesh: a tetrahedron of 1000 to the side.
pub fn robot_folder() -> (tempfile::TempDir, PathBuf, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let inside = folder.path().canonicalize().unwrap().join("my robot \u{1F916}");
    std::fs::create_dir_all(inside.join("meshes")).unwrap();
    std::fs::write(inside.join("meshes/part.stl"), tetrahedron()).unwrap();
    let path = inside.join("arm.urdf");
    std::fs::write(&path, ARM).unwrap();
    let uri = uri(&path);
    (folder, path, uri)
}

fn tetrahedron() -> String {
    let [o, x, y, z] = ["0 0 0", "1000 0 0", "0 1000 0", "0 0 1000"];
    let faces = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
    let face = |[a, b, c]: [&str; 3]| {
        format!(
            "facet normal 0 0 0\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n"
        )
    };
    format!("solid t\n{}endsolid t\n", faces.map(face).concat())
}

/// A URI as VS Code writes it.
pub fn uri(path: &Path) -> String {
    let text = path.to_str().expect("UTF-8");
    let keep = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'/' | b'.' | b'-' | b'_');
    let part = |b: u8| {
        if keep(b) { char::from(b).to_string() } else { format!("%{b:02x}") }
    };
    format!("file://{}", text.bytes().map(part).collect::<String>())
}
